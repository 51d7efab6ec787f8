#include "saca/vehicle/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/core/file.h"
#include "saca/core/units.h"
#include "saca/vehicle/default_car.h"

namespace saca::vehicle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Parameters : public testing::Test {
 protected:
  void SetUp() override {
    text_ = read_file(tree() / "data" / "vehicles" / "compact_rwd_ev.toml").value();
    path_ = fs::path(testing::TempDir()) /
            ("saca_car_" +
             std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");
  }
  void TearDown() override { fs::remove(path_); }

  static fs::path tree() { return fs::path(__FILE__).parent_path().parent_path().parent_path(); }

  // The message about the default car's file with one piece of text replaced.
  std::string complaint(const std::string& old_text, const std::string& new_text) {
    std::string text = text_;
    const std::size_t place = text.find(old_text);
    EXPECT_NE(place, std::string::npos) << old_text;
    text.replace(place, old_text.size(), new_text);
    EXPECT_EQ(write_file(path_, text), std::nullopt);
    const auto car = read_vehicle(path_);
    return car.has_value() ? "accepted" : car.error().message;
  }

  std::string text_;
  fs::path path_;
};

TEST_F(Parameters, OfTheDefaultCarAreRead) {
  const Vehicle car = default_car();
  EXPECT_EQ(car.mass, 1700.0);
  EXPECT_EQ(car.yaw_inertia, 2700.0);
  EXPECT_EQ(car.front_arm + car.rear_arm, 2.8);
  EXPECT_DOUBLE_EQ(car.steering_rate, from_degrees(60.0));
  EXPECT_EQ(car.motor_limit, 3200.0);
  EXPECT_EQ(car.front_end, 2.25);
}

TEST_F(Parameters, AreRefusedWhenMissingUnknownOrInTheWrongUnit) {
  EXPECT_THAT(complaint("mass_kg = 1700.0", ""), HasSubstr("mass_kg"));
  EXPECT_THAT(complaint("mass_kg = 1700.0", "mass_t = 1.7"), HasSubstr("mass"));
  EXPECT_THAT(complaint("mass_kg = 1700.0", "mass_kg = 1.7"), HasSubstr("mass_kg"));
  EXPECT_THAT(complaint("mass_kg = 1700.0", "mass_kg = nan"), HasSubstr("mass_kg"));
  EXPECT_THAT(complaint("[motor]", "[motor]\ngears = 2"), HasSubstr("gears"));
  EXPECT_THAT(complaint("front_end_m = 2.25", "front_end_m = 1.2"), HasSubstr("axles"));
}

TEST_F(Parameters, OfAMissingFileNameIt) {
  const auto car = read_vehicle("no_such_car.toml");
  ASSERT_FALSE(car.has_value());
  EXPECT_EQ(car.error().code, Error::Code::unreadable);
  EXPECT_THAT(car.error().message, HasSubstr("no_such_car.toml"));
}

}  // namespace
}  // namespace saca::vehicle
