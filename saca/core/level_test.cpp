#include "saca/core/level.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace saca::level_test {
namespace {

// The kernel's own list of the processor's abilities is the other opinion.
TEST(Level, IsWhatTheProcessorSays) {
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
  EXPECT_EQ(available(Level::avx2), has("avx2") && has("fma"));
  EXPECT_EQ(available(Level::avx512),
            has("avx512f") && has("avx512cd") && has("avx512dq") && has("avx512bw"));
  EXPECT_TRUE(available(Level::baseline));
  EXPECT_TRUE(available(best_level()));
}

TEST(Level, HasAName) {
  EXPECT_EQ(name(Level::baseline), "baseline");
  EXPECT_EQ(name(Level::avx512), "avx512");
}

}  // namespace
}  // namespace saca::level_test
