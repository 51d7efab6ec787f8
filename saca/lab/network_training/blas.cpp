#include "saca/lab/network_training/blas.h"

#include <unistd.h>

#include <cstdlib>

namespace saca::network_training {

void give_each_thread_its_own_products(char** argv) {
  constexpr const char* threads = "OPENBLAS_NUM_THREADS";
  if (std::getenv(threads) != nullptr) {
    return;
  }
  ::setenv(threads, "1", 0);
  ::execv("/proc/self/exe", argv);  // comes back only if it cannot: slower then, not wrong
}

}  // namespace saca::network_training
