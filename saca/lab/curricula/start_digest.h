#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "saca/thinking/memory/case.h"

namespace saca::curricula {

/// What memories know at the beginning, named for records.
struct StartDigest {
  std::string start;      ///< "12 cases (cbf29ce484222325)": FNV-1a of memory::cases_text
  std::uint64_t all = 0;  ///< of these and of what new cases are made with
};
[[nodiscard]] StartDigest digest_of(std::span<const memory::Case> start,
                                    std::span<const memory::MadeWith> made_with);

}  // namespace saca::curricula
