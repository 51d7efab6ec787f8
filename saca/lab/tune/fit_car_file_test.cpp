#include "saca/lab/tune/fit_car_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/csv.h"
#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/prepare/vehicle_file.h"

namespace saca::tune::fit_car_file_test {
namespace {

using testing::HasSubstr;

class FittedCarFile : public testing::Test {
 protected:
  std::string base_ = read_file("data/vehicles/compact_rwd_ev.toml").value();
  VehicleFit fit_{.car = prepare::default_vehicle()};

  void SetUp() override {
    fit_.car.steering_lag = 0.0712;
    fit_.car.brake_lag = 0.0911;
    fit_.parameters = {
        {"road", "grip", 0.9, 0.8, 0.7, 0.9, true},
        {"tyre", "stiffness", 18.0, 18.0, 0.0, 0.0, false},
        {"steering", "lag_s", 0.05, 0.0712, 0.07, 0.072, true},
        {"brakes", "lag_s", 0.06, 0.0911, 0.09, 0.092, true},
    };
  }
};

TEST_F(FittedCarFile, ChangesTheFittedLinesAndNoOther) {
  const std::string text = fitted_car_file(base_, "car.toml", "a.csv, b.csv", fit_).value();
  std::string_view old_rest = base_;
  std::string_view new_rest = text;
  std::vector<std::string> changed;
  while (!old_rest.empty()) {
    const std::string_view before = cut_line(old_rest);
    const std::string_view after = cut_line(new_rest);
    if (before != after) {
      changed.emplace_back(after);
    }
  }
  EXPECT_TRUE(new_rest.empty());
  EXPECT_THAT(changed,
              testing::ElementsAre(
                  "lag_s = 0.0712  # fitted to a.csv, b.csv: 0.07 to 0.072 (95 %); before: 0.05",
                  "lag_s = 0.0911  # fitted to a.csv, b.csv: 0.09 to 0.092 (95 %); before: 0.06"));
  const vehicle::Vehicle read = prepare::parse_vehicle(text, "car.toml").value();
  EXPECT_EQ(read.steering_lag, 0.0712);
  EXPECT_EQ(read.brake_lag, 0.0911);
  EXPECT_EQ(read.motor_lag, fit_.car.motor_lag);  // another `lag_s`
}

TEST_F(FittedCarFile, RefusesABaseWhoseLineItCannotFind) {
  const std::string old_text = "[steering] ";
  std::string text = base_;
  text.replace(text.find(old_text), old_text.size(), "[\"steering\"] ");
  const auto refused = fitted_car_file(text, "car.toml", "a.csv", fit_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("car.toml: want each fitted key"));
}

TEST_F(FittedCarFile, ALogsNameCannotBreakOutOfItsComment) {
  const auto text = fitted_car_file(base_, "car.toml", "a\nmass_kg = 1\n.csv", fit_);
  ASSERT_TRUE(text.has_value());
  EXPECT_THAT(text.value(), HasSubstr("fitted to a?mass_kg = 1?.csv"));
}

}  // namespace
}  // namespace saca::tune::fit_car_file_test
