#include "saca/lab/reach_study/spare_memory.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace saca::reach_study::spare_memory_test {
namespace {

std::optional<double> told_by(const std::string& text) {
  std::istringstream file(text);
  return available_memory(file);
}

TEST(SpareMemory, IsTheLineOfWhatIsAvailable) {
  EXPECT_EQ(told_by("MemTotal:       65536000 kB\nMemFree:         1024 kB\n"
                    "MemAvailable:   20480 kB\nSwapFree: 3072 kB\n"),
            20.0);
}

TEST(SpareMemory, IsUnknownWhereTheSystemDoesNotSay) {
  EXPECT_EQ(told_by(""), std::nullopt);
  EXPECT_EQ(told_by("MemTotal: 1024 kB\nMemFree: 1024 kB\n"), std::nullopt);
  EXPECT_EQ(told_by("MemTotal: much\nMemAvailable: 1024 kB\n"), std::nullopt);
}

TEST(SpareMemory, IsMoreThanNothingWhereTheSystemSays) {
  const auto spare = spare_memory();
  EXPECT_GT(spare.value_or(1.0), 0.0);
}

}  // namespace
}  // namespace saca::reach_study::spare_memory_test
