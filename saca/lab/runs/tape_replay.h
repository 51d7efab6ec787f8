#pragma once

#include <functional>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/runtime/replay.h"
#include "saca/runtime/tape_json.h"
#include "saca/thinking/intent/cue_law.h"
#include "saca/thinking/intent/model.h"

namespace saca::runs {

/// What there is here to work out a tape again with. What it points to outlives the call.
struct ReplayMeans {
  const manoeuvre::Car* car = nullptr;  ///< that the tape names
  const collision::HarmModel* harm = nullptr;
  const intent::Model* intent = nullptr;
  const intent::CueLaw* cues = nullptr;
  std::string program;  ///< version of this one
  /// The atlas; asked for, perhaps made, only where the tape was recorded with one and all else is
  /// as it was.
  std::function<Result<atlas::Atlas>()> atlas;
};

/// Works out again what stands on a tape (runtime::replay), where that can come out the same.
/// @param source  name of the tape, for messages
/// @return        runtime::mismatch, or what the atlas' opening says
[[nodiscard]] Result<runtime::Replay> replayed(const runtime::TapeFile& tape,
                                               const std::string& source, const ReplayMeans& means);

}  // namespace saca::runs
