#include "saca/base/core/simd_level.h"

#include <array>

#include "saca/base/core/names.h"

namespace saca {

std::string_view name(SimdLevel level) {
  constexpr std::array<std::string_view, 3> names{"baseline", "avx2", "avx512"};
  return name_of(level, names);
}

bool available(SimdLevel level) noexcept {
#if defined(__x86_64__)
  if (level == SimdLevel::avx2) {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  }
  if (level == SimdLevel::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0;
  }
#endif
  return level == SimdLevel::baseline;
}

SimdLevel best_level() noexcept {
  return available(SimdLevel::avx512) ? SimdLevel::avx512
         : available(SimdLevel::avx2) ? SimdLevel::avx2
                                      : SimdLevel::baseline;
}

}  // namespace saca
