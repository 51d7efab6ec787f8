#pragma once

#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"

namespace saca::model_trials {

/// What a language model would first have been asked in an encounter: its previews, with their
/// prompts; none: nothing ever threatened.
///
/// The encounter is played without a model, in lockstep, as if thinking took no time.
/// @param setup  its model, memory, pace and costs are not used
/// @return       as encounter::run
[[nodiscard]] Result<std::vector<arbitration::Preview>> first_question(encounter::Setup setup);

}  // namespace saca::model_trials
