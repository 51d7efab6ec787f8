#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"
#include "saca/lab/crash_records/roles.h"

namespace saca::crash_records {

/// One thing that a record says, as it stands there and in words.
struct Fact {
  std::string about;  ///< crash, ego, other or person
  std::string key;    ///< the column
  Code code;          ///< nullopt: not known
  std::string words;
};

/// What a record says of the crash and of those who take part when it is played.
[[nodiscard]] std::vector<Fact> facts_of(const FarsCrash& crash, const Roles& roles,
                                         const FarsCodes& codes);

}  // namespace saca::crash_records
