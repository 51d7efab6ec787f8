#include "saca/manoeuvre/car.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/core/file.h"
#include "saca/vehicle/default_car.h"

namespace saca::manoeuvre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Car, IsItsParametersAndTheTuningBesideThem) {
  const fs::path tree = fs::path(__FILE__).parent_path().parent_path().parent_path();
  const auto car = read_car(tree / "data/vehicles/compact_rwd_ev.toml");
  ASSERT_TRUE(car.has_value()) << car.error().message;
  EXPECT_EQ(car.value().mass, vehicle::default_car().mass);
  const auto tuning = read_tuning(tree / "data/vehicles/compact_rwd_ev.tuning.toml");
  ASSERT_TRUE(tuning.has_value());
  EXPECT_EQ(car.value().tuning.drift.turning, tuning.value().drift.turning);
}

TEST(Car, WithoutTuningSaysWhatMakesIt) {
  const fs::path tree = fs::path(__FILE__).parent_path().parent_path().parent_path();
  const fs::path alone = fs::path(testing::TempDir()) / "saca_car_alone.toml";
  ASSERT_EQ(write_file(alone, read_file(tree / "data/vehicles/compact_rwd_ev.toml").value()),
            std::nullopt);
  const auto car = read_car(alone);
  fs::remove(alone);
  ASSERT_FALSE(car.has_value());
  EXPECT_THAT(car.error().message, HasSubstr("saca_car_alone.tuning.toml"));
  EXPECT_THAT(car.error().message, HasSubstr("saca tune --car"));
}

}  // namespace
}  // namespace saca::manoeuvre
