#pragma once

#include <cstdint>
#include <string_view>

namespace saca {

/// Instruction sets that inner loops are compiled for.
enum class Level : std::uint8_t { baseline, avx2, avx512 };
/// "baseline", "avx2", "avx512".
[[nodiscard]] std::string_view name(Level level);

/// Whether this processor has it.
[[nodiscard]] bool available(Level level) noexcept;
/// The largest that is available.
[[nodiscard]] Level best_level() noexcept;

}  // namespace saca
