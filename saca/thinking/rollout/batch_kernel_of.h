#pragma once

#include "saca/thinking/rollout/batch_kernel.h"
#include "saca/thinking/rollout/batch_level.h"
#include "saca/thinking/rollout/batch_pack.h"

/// What a kernel is made of, for one instruction set. Templates only: nothing that is compiled for
/// one instruction set may be shared with code for another.
namespace saca::rollout::lanes {

/// Numbers too small for all digits count as zero: they would be slow, and mean nothing here.
template <class Arch>
class FlushTiny {
 public:
#if defined(__x86_64__)
  FlushTiny() : before_(__builtin_ia32_stmxcsr()) {
    __builtin_ia32_ldmxcsr(before_ | 0x8040U);
  }
  ~FlushTiny() {
    __builtin_ia32_ldmxcsr(before_);
  }

 private:
  unsigned before_;
#else
  FlushTiny() {}
  ~FlushTiny() {}
#endif
 public:
  FlushTiny(const FlushTiny&) = delete;
  FlushTiny& operator=(const FlushTiny&) = delete;
};

template <class Arch, Kind kind>
[[gnu::flatten]] void advance_all(float* memory, std::size_t now, std::size_t late) {
  using Number = Pack<Arch>;
  static_assert(sizeof(Lane<Number>) == sizeof(Lane<float>) * Number::size);
  static_assert(Number::size <= most_lanes);
  const FlushTiny<Arch> flush;
  auto& lane = *reinterpret_cast<Lane<Number>*>(memory);  // vectors may alias what they hold
  for (int i = 0; i < steps_per_pose(kind); ++i) {
    advance<kind, Number>(lane.fixed, lane.moving, now + static_cast<std::size_t>(i), late);
  }
}

template <class Arch>
Kernel kernel_of() {
  return {Pack<Arch>::size,
          {&advance_all<Arch, Kind::keeps_speed>, &advance_all<Arch, Kind::brakes>,
           &advance_all<Arch, Kind::drifts>}};
}

}  // namespace saca::rollout::lanes
