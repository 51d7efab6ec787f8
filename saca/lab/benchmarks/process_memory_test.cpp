#include "saca/lab/benchmarks/process_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
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
  if (process_memory("VmHWM") == 0.0 || ::access("/proc/self/clear_refs", W_OK) != 0) {
    GTEST_SKIP() << "this system does not tell, or does not forget";
  }
  constexpr std::size_t bytes = 64U << 20U;  // given back at once, unlike what is allocated
  void* const held =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(held, MAP_FAILED);
  std::memset(held, 1, bytes);
  ASSERT_EQ(::munmap(held, bytes), 0);
  const double peak = process_memory("VmHWM");
  forget_memory_peak();
  EXPECT_LT(process_memory("VmHWM"), peak - 32.0);
  EXPECT_GT(process_memory("VmHWM"), 0.0);
}

}  // namespace
}  // namespace saca::benchmarks::process_memory_test
