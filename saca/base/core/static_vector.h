#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "saca/base/core/contract.h"

namespace saca {

/// A list with room for `capacity` elements inside the object itself: no allocation, and trivially
/// copyable, so that it can cross between planes byte by byte.
template <class T, std::size_t capacity_>
class StaticVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  [[nodiscard]] static constexpr std::size_t capacity() { return capacity_; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == capacity_; }

  /// @throws ContractViolation  when full
  constexpr void push_back(const T& value) {
    expects(!full(), "size < capacity");
    items_[size_++] = value;
  }
  constexpr void clear() { size_ = 0; }

  [[nodiscard]] constexpr const T& operator[](std::size_t i) const {
    expects(i < size_, "index < size");
    return items_[i];
  }
  [[nodiscard]] constexpr T& operator[](std::size_t i) {
    expects(i < size_, "index < size");
    return items_[i];
  }

  [[nodiscard]] constexpr const T* begin() const { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const { return items_.data() + size_; }
  [[nodiscard]] constexpr T* begin() { return items_.data(); }
  [[nodiscard]] constexpr T* end() { return items_.data() + size_; }

  [[nodiscard]] friend constexpr bool operator==(const StaticVector& a, const StaticVector& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::array<T, capacity_> items_{};
  std::size_t size_ = 0;
};

}  // namespace saca
