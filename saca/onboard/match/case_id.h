#pragma once

#include <cstdint>

namespace saca::match {

/// Names a case in its bank; given by the store, from 1 on.
using CaseId = std::int64_t;

}  // namespace saca::match
