#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca {

/// A bounded first-in, first-out queue from one producer thread to one consumer thread (a ring
/// buffer). Neither ever waits: what does not fit is left out and counted.
///
/// All room is taken when it is made. Calls are wait-free and allocate nothing, apart from what
/// moving a value does.
template <class T>
class SpscQueue {
  static_assert(std::is_nothrow_move_assignable_v<T> && std::is_nothrow_move_constructible_v<T>);
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

 public:
  /// @param capacity  >= 1
  explicit SpscQueue(std::size_t capacity) : values_(capacity) {
    expects(capacity >= 1, "capacity >= 1");
  }
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;
  ~SpscQueue() = default;

  /// Producer: appends the value, or counts it as rejected where the queue is full.
  void push(T value) noexcept {
    const std::size_t end = pushed_.load(std::memory_order_relaxed);
    if (end - popped_.load(std::memory_order_acquire) == values_.size()) {
      num_rejected_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    values_[end % values_.size()] = std::move(value);
    pushed_.store(end + 1, std::memory_order_release);
  }

  /// Consumer: the oldest value, which stays; nullptr when there is none.
  [[nodiscard]] const T* front() const noexcept {
    const std::size_t begin = popped_.load(std::memory_order_relaxed);
    return begin == pushed_.load(std::memory_order_acquire) ? nullptr
                                                            : &values_[begin % values_.size()];
  }

  /// Consumer: takes the oldest value; nullopt when there is none.
  [[nodiscard]] std::optional<T> pop() noexcept {
    if (front() == nullptr) {
      return std::nullopt;
    }
    const std::size_t begin = popped_.load(std::memory_order_relaxed);
    std::optional<T> value = std::move(values_[begin % values_.size()]);
    popped_.store(begin + 1, std::memory_order_release);
    return value;
  }

  /// How many values did not fit so far. Any thread.
  [[nodiscard]] std::size_t num_rejected() const noexcept {
    return num_rejected_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t line = 64;  ///< of a cache: no two threads write to the same [byte]

  std::vector<T> values_;
  alignas(line) std::atomic<std::size_t> pushed_ = 0;  ///< values so far; the producer's
  std::atomic<std::size_t> num_rejected_ = 0;          ///< likewise
  alignas(line) std::atomic<std::size_t> popped_ = 0;  ///< values so far; the consumer's
};

}  // namespace saca
