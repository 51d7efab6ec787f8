#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace saca {

/// Hands the newest value from one thread to another: neither ever waits, and what the reader has
/// not taken in time is replaced.
///
/// One producer thread and one consumer thread. Both calls are wait-free and allocate nothing: of
/// three buffers each side owns one, and they swap theirs with the third.
template <class T>
class LatestSlot {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

 public:
  LatestSlot() = default;
  LatestSlot(const LatestSlot&) = delete;
  LatestSlot& operator=(const LatestSlot&) = delete;

  /// Producer: makes `value` the newest.
  void publish(const T& value) noexcept {
    buffers_[written_].value = value;
    written_ = shared_.exchange(written_ | fresh, std::memory_order_acq_rel) & index;
  }

  /// Consumer: the newest value into `value`, if it has not been taken yet.
  /// @return  false when there is nothing new; `value` is then untouched
  [[nodiscard]] bool take(T& value) noexcept {
    if ((shared_.load(std::memory_order_relaxed) & fresh) == 0) {
      return false;
    }
    // Only the consumer clears `fresh`, so what comes back is fresh too, perhaps even newer.
    read_ = shared_.exchange(read_, std::memory_order_acq_rel) & index;
    value = buffers_[read_].value;
    return true;
  }

 private:
  static constexpr std::uint8_t index = 3;
  static constexpr std::uint8_t fresh = 4;  ///< flag: the third buffer has not been taken
  static constexpr std::size_t line = 64;   ///< of a cache: no two threads write to the same [byte]

  struct alignas(line) Buffer {
    T value{};
  };

  std::array<Buffer, 3> buffers_{};
  alignas(line) std::atomic<std::uint8_t> shared_ = 1;  ///< index of the third buffer, and flag
  alignas(line) std::uint8_t written_ = 0;              ///< the producer's own
  alignas(line) std::uint8_t read_ = 2;                 ///< the consumer's own
};

}  // namespace saca
