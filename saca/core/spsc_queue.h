#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

namespace saca {

/// Bounded queue from one producer thread to one consumer thread: neither ever waits, and nothing
/// is lost or doubled; when it is full, the producer is told.
///
/// Both calls are wait-free and allocate nothing.
template <class T, std::size_t capacity_>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(capacity_ > 0);
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

 public:
  SpscQueue() = default;
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  [[nodiscard]] static constexpr std::size_t capacity() { return capacity_; }

  /// Producer.
  /// @return  false when it is full; the queue is then as it was
  [[nodiscard]] bool push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t after = next(tail);
    if (after == head_.load(std::memory_order_acquire)) {
      return false;
    }
    items_[tail] = value;
    tail_.store(after, std::memory_order_release);
    return true;
  }

  /// Consumer: the oldest value into `value`.
  /// @return  false when it is empty; `value` is then untouched
  [[nodiscard]] bool pop(T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) {
      return false;
    }
    value = items_[head];
    head_.store(next(head), std::memory_order_release);
    return true;
  }

 private:
  static constexpr std::size_t num_items = capacity_ + 1;  ///< one stays empty: full is not empty
  static constexpr std::size_t line = 64;  ///< of a cache: no two threads write to the same [byte]

  static constexpr std::size_t next(std::size_t i) { return i + 1 == num_items ? 0 : i + 1; }

  std::array<T, num_items> items_{};
  alignas(line) std::atomic<std::size_t> head_ = 0;  ///< of the oldest; written by the consumer
  alignas(line) std::atomic<std::size_t> tail_ = 0;  ///< behind the newest; by the producer
};

}  // namespace saca
