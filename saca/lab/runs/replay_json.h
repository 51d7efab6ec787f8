#pragma once

#include <nlohmann/json.hpp>

#include "saca/runtime/replay.h"
#include "saca/runtime/tape_json.h"

namespace saca::runs {

/// The document of `saca replay --json`: schema saca.replay/1.
[[nodiscard]] nlohmann::json replay_json(const runtime::TapeFile& tape,
                                         const runtime::Replay& replay);

}  // namespace saca::runs
