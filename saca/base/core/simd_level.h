#pragma once

#include <cstdint>
#include <string_view>

namespace saca {

/// Instruction sets that inner loops are compiled for.
enum class SimdLevel : std::uint8_t { baseline, avx2, avx512 };
/// "baseline", "avx2", "avx512".
[[nodiscard]] std::string_view name(SimdLevel level);

/// Whether this processor has it.
[[nodiscard]] bool available(SimdLevel level) noexcept;
/// The largest that is available.
[[nodiscard]] SimdLevel best_level() noexcept;

}  // namespace saca
