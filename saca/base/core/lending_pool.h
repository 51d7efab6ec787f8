#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca {

/// Things of one kind that only one thread at a time may use, lent to several threads. It does not
/// matter which of them somebody gets.
template <class T>
class LendingPool {
 public:
  /// What is lent, until it is let go.
  using Loan = std::unique_ptr<T, std::function<void(T*)>>;

  explicit LendingPool(std::vector<T> things) : things_(std::move(things)) {
    expects(!things_.empty(), "at least one");
    for (T& thing : things_) {
      free_.push_back(&thing);
    }
  }
  LendingPool(const LendingPool&) = delete;
  LendingPool& operator=(const LendingPool&) = delete;
  ~LendingPool() = default;

  /// Waits until one is there. The pool outlives the loan.
  [[nodiscard]] Loan lend() {
    std::unique_lock lock(mutex_);
    given_back_.wait(lock, [&] { return !free_.empty(); });
    T* const thing = free_.back();
    free_.pop_back();
    return Loan(thing, [this](T* back) { take_back(back); });
  }

 private:
  void take_back(T* thing) {
    const std::lock_guard lock(mutex_);
    free_.push_back(thing);  // never more than there were: allocates nothing
    given_back_.notify_one();
  }

  std::vector<T> things_;
  std::mutex mutex_;
  std::condition_variable given_back_;
  std::vector<T*> free_;
};

}  // namespace saca
