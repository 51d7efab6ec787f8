#pragma once

#include <string>

#include "saca/runtime/replay.h"
#include "saca/runtime/tape_json.h"

namespace saca::runs {

/// What came of a replay for people: of each kind of result how many came back the same, what could
/// not be compared, and the first difference.
[[nodiscard]] std::string replay_text(const runtime::TapeFile& tape, const runtime::Replay& replay);

}  // namespace saca::runs
