#include "saca/lab/benchmarks/reach_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::benchmarks::reach_times_test {
namespace {

const Note nobody = [](const std::string&) {};

// All of it takes minutes: here only what it asks for.
TEST(ReachTimes, NameTheFileThatIsMissing) {
  const SteadyClock clock;
  const auto reach = reach_times("no_such_folder", prepare::default_car(), clock, nobody);
  ASSERT_FALSE(reach.has_value());
  EXPECT_THAT(reach.error().message, testing::HasSubstr("no_such_folder/data/reach/parked_car"));
  const auto air3d = coarse_air3d_times("no_such_folder", clock, nobody);
  ASSERT_FALSE(air3d.has_value());
  EXPECT_THAT(air3d.error().message,
              testing::HasSubstr("no_such_folder/data/reference/air3d_hj_reachability.json"));
}

}  // namespace
}  // namespace saca::benchmarks::reach_times_test
