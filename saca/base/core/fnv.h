#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace saca {

/// FNV-1a, a hash that is the same everywhere and for ever: to name content, not to protect it.
/// Source: Fowler, Noll, Vo, offset basis and prime as published for 64 bits.
class Fnv {
 public:
  /// One step over a byte, or over a whole word (which is no longer the published function).
  constexpr void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 1099511628211U; }
  /// The published function of a text.
  constexpr void add(std::string_view text) {
    for (const char c : text) {
      add(static_cast<unsigned char>(c));
    }
  }
  /// The bits of a value that consists of doubles only.
  template <class Doubles>
  constexpr void add_doubles(const Doubles& values) {
    static_assert(sizeof(Doubles) % sizeof(double) == 0);
    for (const std::uint64_t bits :
         std::bit_cast<std::array<std::uint64_t, sizeof(Doubles) / sizeof(double)>>(values)) {
      add(bits);
    }
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

/// The published function of one text.
constexpr std::uint64_t fnv1a(std::string_view text) {
  Fnv hash;
  hash.add(text);
  return hash.value();
}

}  // namespace saca
