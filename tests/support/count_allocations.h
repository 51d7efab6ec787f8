#pragma once

#include <cstddef>

namespace saca {

/// How often a test's thread has taken memory from the heap. A program that names it counts:
/// operator new is replaced in all of it.
extern constinit thread_local std::size_t num_allocations;

}  // namespace saca
