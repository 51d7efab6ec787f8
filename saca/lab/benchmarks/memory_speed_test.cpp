#include "saca/lab/benchmarks/memory_speed.h"

#include <gtest/gtest.h>

#include "saca/lab/benchmarks/ticking_clock_for_test.h"

namespace saca::benchmarks::memory_speed_test {
namespace {

// 640 floats of three arrays within the millisecond that a run takes by this clock.
TEST(MemorySpeed, CountsTwoReadsAndAWrite) {
  const TickingClock clock;
  EXPECT_NEAR(memory_speed(2, clock, 640), 3.0 * 4.0 * 640.0 / 1e-3, 1e-3);
}

// 3.5 floats are 14 bytes: at 7 GB/s they take 2 ns.
TEST(MemorySpeed, IsTheRoofOfASolver) {
  const nlohmann::json all = roofline(7e9, 8.0);
  EXPECT_NEAR(all.at("reach.memory_gb_per_s").get<double>(), 7.0, 1e-12);
  EXPECT_EQ(all.at("reach.bytes_per_point_stage"), 14.0);
  EXPECT_NEAR(all.at("reach.roofline_share").get<double>(), 0.25, 1e-12);
}

}  // namespace
}  // namespace saca::benchmarks::memory_speed_test
