#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <iostream>
#include <string_view>
#include <vector>

#include "saca/core/level.h"

namespace saca::test {

inline std::string_view name_of(Level level) {
  switch (level) {
    case Level::baseline:
      return "baseline";
    case Level::avx2:
      return "AVX2";
    case Level::avx512:
      return "AVX-512";
  }
  return "?";
}

/// Of these instruction sets those that this processor has. Of each other the test's output says
/// that it was not tested, in the words of a skipped test, which tools/check.sh repeats at its end.
inline std::vector<Level> those_here(std::initializer_list<Level> levels) {
  std::vector<Level> here;
  for (const Level level : levels) {
    if (available(level)) {
      here.push_back(level);
    } else {
      const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
      std::cout << test.file() << ':' << test.line() << ": Skipped\nin part: this processor has no "
                << name_of(level) << '\n';
    }
  }
  return here;
}

}  // namespace saca::test
