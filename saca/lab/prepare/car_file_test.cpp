#include "saca/lab/prepare/car_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/prepare/tuning_file.h"

namespace saca::prepare::car_file_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Car, IsItsParametersAndTheTuningBesideThem) {
  const auto car = read_car("data/vehicles/compact_rwd_ev.toml");
  ASSERT_TRUE(car.has_value()) << car.error().message;
  EXPECT_EQ(car.value().mass, default_vehicle().mass);
  const auto tuning = read_tuning("data/vehicles/compact_rwd_ev.tuning.toml");
  ASSERT_TRUE(tuning.has_value());
  EXPECT_EQ(car.value().tuning.drift.turning, tuning.value().drift.turning);
}

TEST(Car, WithoutTuningSaysWhatMakesIt) {
  const fs::path alone = fs::path(testing::TempDir()) / "saca_car_alone.toml";
  ASSERT_EQ(write_file(alone, read_file("data/vehicles/compact_rwd_ev.toml").value()),
            std::nullopt);
  const auto car = read_car(alone);
  fs::remove(alone);
  ASSERT_FALSE(car.has_value());
  EXPECT_THAT(car.error().message, HasSubstr("saca_car_alone.tuning.toml"));
  EXPECT_THAT(car.error().message, HasSubstr("saca tune --car"));
}

}  // namespace
}  // namespace saca::prepare::car_file_test
