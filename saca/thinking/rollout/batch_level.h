#pragma once

#include <array>
#include <cstddef>

#include "saca/thinking/rollout/batch_lane.h"

/// The batch's kernels, one for each instruction set. Not part of the library's interface.
namespace saca::rollout::lanes {

/// Goes on to the next pose with all lanes of a pack, which lie side by side in `memory`, a
/// `Lane<float>` with every number repeated `num_lanes` times.
/// @param now   steps of this pack so far
/// @param late  the brakes' dead time in steps, of all lanes
using Advance = void (*)(float* memory, std::size_t now, std::size_t late);

struct Kernel {
  std::size_t num_lanes;                   ///< at most `most_lanes`
  std::array<Advance, num_kinds> advance;  ///< by `Kind`
};
constexpr std::size_t most_lanes = 16;

[[nodiscard]] Kernel kernel_baseline() noexcept;
#if defined(__x86_64__)
[[nodiscard]] Kernel kernel_avx2() noexcept;
[[nodiscard]] Kernel kernel_avx512() noexcept;
#endif

}  // namespace saca::rollout::lanes
