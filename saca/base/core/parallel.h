#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace saca {

/// As many threads as the machine runs at once; at least one.
inline int usual_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Calls work(i) once for every i below `count`, on several threads; returns when all are done.
///
/// What `work` writes must be its own: one element of an array, say. Then the result does not
/// depend on the number of threads. What `work` throws is thrown again when all threads have
/// stopped; the rest of the work is then left undone.
template <class Work>
void in_parallel(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr problem;
  std::mutex lock;
  const auto worker = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        work(i);
      }
    } catch (...) {
      const std::lock_guard guard(lock);
      problem = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) {
      others.emplace_back(worker);
    }
    worker();
  }
  if (problem) {
    std::rethrow_exception(problem);
  }
}

}  // namespace saca
