#include "free_cores.h"

#include <gtest/gtest.h>

namespace saca::model_host::free_cores_test {
namespace {

constexpr const char* stat =
    "cpu  300 0 60 900 40 1 2 3 0 0\n"
    "cpu0 100 0 20 400 10 1 2 3 0 0\n"
    "cpu1 100 0 20 300 20 0 0 0 0 0\n"
    "cpu10 100 0 20 200 10 0 0 0 0 0\n"
    "intr 5 6 7\n"
    "cpux 1 2 3 4 5\n"
    "cpu99999999999999999999 1 2 3 4 5\n"
    "cpu2 broken\n";

TEST(FreeCores, IdleTimeIsOfOurProcessorsAlone) {
  const auto all = [](int) { return true; };
  EXPECT_EQ(idle_seconds(stat, all, 100.0), (410.0 + 320.0 + 210.0) / 100.0);
  EXPECT_EQ(idle_seconds(
                stat, [](int cpu) { return cpu == 1; }, 100.0),
            3.2);
  EXPECT_EQ(idle_seconds(
                stat, [](int cpu) { return cpu == 10; }, 1000.0),
            0.21);
  EXPECT_EQ(idle_seconds(
                stat, [](int cpu) { return cpu == 7; }, 100.0),
            std::nullopt);
  EXPECT_EQ(idle_seconds("", all, 100.0), std::nullopt);
}

// Whatever else runs: what it tells is between nothing and all processors.
TEST(FreeCores, TellsOfTheTimeSinceItWasAskedLast) {
  FreeCores cores;
  EXPECT_EQ(cores.since_last(), std::nullopt) << "there is nothing to compare with";
  EXPECT_EQ(cores.since_last(), std::nullopt) << "too short";
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() < begin + std::chrono::milliseconds(150)) {
  }
  const std::optional<double> told = cores.since_last();
  ASSERT_TRUE(told.has_value());
  EXPECT_GE(*told, 0.0);
  EXPECT_LE(*told, 1.5 * static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN)) + 1.0);
}

}  // namespace
}  // namespace saca::model_host::free_cores_test
