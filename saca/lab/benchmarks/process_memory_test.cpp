#include "saca/lab/benchmarks/process_memory.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace saca::benchmarks::process_memory_test {
namespace {

TEST(ProcessMemory, IsTheLineOfThatName) {
  const std::string status = "Name:\tsaca\nVmHWM:\t    5120 kB\nVmRSS:\t    2048 kB\n";
  std::istringstream first(status);
  EXPECT_EQ(status_memory(first, "VmRSS"), 2.0);
  std::istringstream second(status);
  EXPECT_EQ(status_memory(second, "VmHWM"), 5.0);
  std::istringstream third(status);
  EXPECT_EQ(status_memory(third, "Vm"), 0.0);
  std::istringstream empty;
  EXPECT_EQ(status_memory(empty, "VmRSS"), 0.0);
}

TEST(ProcessMemory, GrowsWithWhatIsHeld) {
  const double before = process_memory("VmRSS");
  if (before == 0.0) {
    GTEST_SKIP() << "this system does not tell";
  }
  const std::vector<char> held(64U << 20U, 'x');
  EXPECT_GT(process_memory("VmRSS"), before + 50.0) << held[0];
}

TEST(ProcessMemory, HasAPeakThatCanBeForgotten) {
  { const std::vector<char> held(64U << 20U, 'x'); }
  const double peak = process_memory("VmHWM");
  forget_memory_peak();
  EXPECT_LE(process_memory("VmHWM"), peak);
  EXPECT_GE(process_memory("VmHWM"), 0.0);
}

}  // namespace
}  // namespace saca::benchmarks::process_memory_test
