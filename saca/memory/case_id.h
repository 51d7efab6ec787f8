#pragma once

#include <cstdint>

namespace saca::memory {

/// Names a case in its bank; given by the store, from 1 on.
using CaseId = std::int64_t;

}  // namespace saca::memory
