#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <iostream>
#include <string_view>
#include <vector>

#include "saca/base/core/simd_level.h"

namespace saca::test {

inline std::string_view name_of(SimdLevel level) {
  switch (level) {
    case SimdLevel::baseline:
      return "baseline";
    case SimdLevel::avx2:
      return "AVX2";
    case SimdLevel::avx512:
      return "AVX-512";
  }
  return "?";
}

/// Of these instruction sets those that this processor has. Of each other the test's output says
/// that it was not tested, in the words of a skipped test, which tools/check.sh repeats at its end.
inline std::vector<SimdLevel> those_here(std::initializer_list<SimdLevel> levels) {
  std::vector<SimdLevel> here;
  for (const SimdLevel level : levels) {
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
