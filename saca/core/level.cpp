#include "saca/core/level.h"

#include <array>

#include "saca/core/names.h"

namespace saca {

std::string_view name(Level level) {
  constexpr std::array<std::string_view, 3> names{"baseline", "avx2", "avx512"};
  return name_of(level, names);
}

bool available(Level level) noexcept {
#if defined(__x86_64__)
  if (level == Level::avx2) {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  }
  if (level == Level::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0;
  }
#endif
  return level == Level::baseline;
}

Level best_level() noexcept {
  return available(Level::avx512) ? Level::avx512
         : available(Level::avx2) ? Level::avx2
                                  : Level::baseline;
}

}  // namespace saca
