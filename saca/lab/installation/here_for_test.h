#pragma once

#include <gtest/gtest.h>

#include "saca/lab/installation/installation.h"

namespace saca::installation {

/// This project's own files, and a cache that is the test program's.
inline Installation here_for_test() {
  return {.root = ".",
          .model_host = "no_host",
          .cache = std::filesystem::path(testing::TempDir()) / "saca_cache",
          .version = "1.2.3",
          .commit = "abc",
          .model_key = "key",
          .display = long_work::ProgressDisplay::silent};
}

}  // namespace saca::installation
