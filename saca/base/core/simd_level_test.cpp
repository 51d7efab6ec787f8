#include "saca/base/core/simd_level.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace saca::simd_level_test {
namespace {

// The kernel's own list of the processor's abilities is the other opinion.
TEST(SimdLevel, IsWhatTheProcessorSays) {
#if !defined(__x86_64__)
  GTEST_SKIP() << "another processor, emulated perhaps: the list is the machine's";
#endif
  std::ifstream file("/proc/cpuinfo");
  std::string flags;
  for (std::string line; std::getline(file, line) && flags.empty();) {
    flags = line.rfind("flags", 0) == 0 ? line + ' ' : "";
  }
  if (flags.empty()) {
    GTEST_SKIP() << "this system does not list them";
  }
  const auto has = [&](const std::string& flag) {
    return flags.find(' ' + flag + ' ') != std::string::npos;
  };
  EXPECT_EQ(available(SimdLevel::avx2), has("avx2") && has("fma"));
  EXPECT_EQ(available(SimdLevel::avx512),
            has("avx512f") && has("avx512cd") && has("avx512dq") && has("avx512bw"));
  EXPECT_TRUE(available(SimdLevel::baseline));
  EXPECT_TRUE(available(best_level()));
}

TEST(SimdLevel, HasAName) {
  EXPECT_EQ(name(SimdLevel::baseline), "baseline");
  EXPECT_EQ(name(SimdLevel::avx512), "avx512");
}

}  // namespace
}  // namespace saca::simd_level_test
