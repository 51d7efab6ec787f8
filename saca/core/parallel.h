#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
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
/// depend on the number of threads. `work` must not throw.
template <class Work>
void in_parallel(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) {
    others.emplace_back(worker);
  }
  worker();
}

}  // namespace saca
