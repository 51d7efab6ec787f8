#include "saca/lab/benchmarks/chosen_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::benchmarks::chosen_times_test {
namespace {

using testing::HasSubstr;

Result<nlohmann::json> times_of(const installation::Installation& here, const std::string& what) {
  const SteadyClock clock;
  return chosen_times(here, {.what = what, .calls = 1'000}, clock, [](const std::string&) {});
}

TEST(ChosenTimes, AreOfThePartThatIsAskedFor) {
  const auto vehicle = times_of(installation::here_for_test(), "vehicle");
  ASSERT_TRUE(vehicle.has_value()) << vehicle.error().message;
  ASSERT_FALSE(vehicle.value().empty());
  for (const auto& [name, value] : vehicle.value().items()) {
    EXPECT_THAT(name, HasSubstr("vehicle")) << name;
    EXPECT_GT(value.get<double>(), 0.0) << name;
  }
}

TEST(ChosenTimes, NeedTheProgramsOwnFiles) {
  EXPECT_FALSE(times_of({.root = "/nowhere"}, "vehicle").has_value());
}

}  // namespace
}  // namespace saca::benchmarks::chosen_times_test
