#pragma once

#include <string>
#include <string_view>

#include "saca/lab/eval/cue_forecast.h"
#include "saca/thinking/intent/cue_law.h"

namespace saca::family_samples {

/// The file that tells SACA what to reckon with (data/cues.toml: docs/formats.md), with where each
/// number comes from: who comes and how as in `law`, how often as counted, rounded up to four
/// digits.
/// @param suite  that was counted in
[[nodiscard]] std::string counted_law_text(const intent::CueLaw& law, const eval::CueCounts& counts,
                                           std::string_view suite);

}  // namespace saca::family_samples
