#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace saca {

// The words by which an enumeration stands in files, in the enumeration's order.

template <class Enum, std::size_t size>
[[nodiscard]] constexpr std::string_view name_of(Enum value,
                                                 const std::array<std::string_view, size>& names) {
  const auto i = static_cast<std::size_t>(value);
  return i < size ? names[i] : std::string_view("?");
}

template <class Enum, std::size_t size>
[[nodiscard]] constexpr std::optional<Enum> value_from(
    std::string_view name, const std::array<std::string_view, size>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<Enum>(found - names.begin());
}

}  // namespace saca
