#include "saca/lab/installation/inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "saca/base/core/file.h"
#include "saca/lab/installation/here_for_test.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::installation::inputs_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Inputs, AreThoseOfTheNamedCar) {
  const auto inputs = read_inputs(here_for_test(), "compact_rwd_ev");
  ASSERT_TRUE(inputs.has_value());
  EXPECT_EQ(inputs.value().car_name, "compact_rwd_ev");
  EXPECT_DOUBLE_EQ(inputs.value().car.mass, prepare::default_car().mass);
  EXPECT_EQ(read_named_car(here_for_test(), "data/vehicles/midsize_suv.toml").value().name,
            "midsize_suv");
  EXPECT_THAT(read_inputs(here_for_test(), "no_car").error().message, HasSubstr("no_car: no car"));
}

TEST(Inputs, OfAScenarioAreItsCars) {
  const auto inputs = read_scenario_inputs(here_for_test(), "one_way");
  ASSERT_TRUE(inputs.has_value());
  EXPECT_EQ(inputs.value().scenario.name, "one_way");
  EXPECT_EQ(inputs.value().car_name, inputs.value().scenario.car);
}

/// How far the car's body is before its origin [m].
double front_of(const std::string& car) {
  const auto named = read_named_car(here_for_test(), car);
  const world::Footprint body = manoeuvre::footprint(named.value().car);
  return body.centre_x + 0.5 * body.length;
}

// What stands between the fronts of a compact car and of a van touches the van alone.
TEST(Inputs, AScenarioIsReadWithTheBodyOfItsCar) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "near_body.toml";
  const double between = 0.5 * (front_of("compact_rwd_ev") + front_of("delivery_van"));
  ASSERT_GT(std::abs(front_of("delivery_van") - between), 0.05);
  const auto problem = [&](const std::string& car) {
    std::string text = read_file("scenarios/one_way.toml").value();
    const auto put = [&](const std::string& old, const std::string& now) {
      ASSERT_NE(text.find(old), std::string::npos);
      text.replace(text.find(old), old.size(), now);
    };
    put("car = \"compact_rwd_ev\"", "car = \"" + car + "\"");
    put("s_m = 66", "s_m = " + std::to_string(3.5 + between));  // an ellipse 7 m long
    EXPECT_EQ(write_file(file, text), std::nullopt);
    const auto read = read_scenario_inputs(here_for_test(), file.string());
    return read.has_value() ? std::string() : read.error().message;
  };
  const bool van_is_longer = front_of("delivery_van") > front_of("compact_rwd_ev");
  EXPECT_EQ(problem(van_is_longer ? "compact_rwd_ev" : "delivery_van"), "");
  EXPECT_THAT(problem(van_is_longer ? "delivery_van" : "compact_rwd_ev"),
              HasSubstr("near_body.toml"));
  std::filesystem::remove(file);
}

TEST(Inputs, AScenarioOfAnUnknownCarIsRefusedWithFileAndKey) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "unknown_car.toml";
  std::string text = read_file("scenarios/one_way.toml").value();
  const std::string car = "compact_rwd_ev";
  ASSERT_NE(text.find(car), std::string::npos);
  text.replace(text.find(car), car.size(), "compact_rwd_evv");
  ASSERT_EQ(write_file(file, text), std::nullopt);
  const auto inputs = read_scenario_inputs(here_for_test(), file.string());
  ASSERT_FALSE(inputs.has_value());
  EXPECT_THAT(inputs.error().message,
              AllOf(HasSubstr("unknown_car.toml: car: "), HasSubstr("compact_rwd_ev")));
  std::filesystem::remove(file);
}

TEST(Inputs, AFolderWithoutThemIsTold) {
  const Installation nowhere{.root = "/nowhere"};
  EXPECT_THAT(read_harm(nowhere).error().message, HasSubstr("/nowhere/data/harm.toml"));
  EXPECT_THAT(read_costs(nowhere).error().message, HasSubstr("thinking_costs.toml"));
  EXPECT_TRUE(read_costs(here_for_test()).has_value());
}

}  // namespace
}  // namespace saca::installation::inputs_test
