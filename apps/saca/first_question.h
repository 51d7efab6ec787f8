#pragma once

#include <vector>

#include "apps/saca/inputs.h"
#include "saca/lab/encounter/encounter.h"

namespace saca::app {

/// An encounter that was played without a model, and what one would first have been asked in it.
struct FirstQuestion {
  encounter::Record record;
  std::vector<arbitration::Preview>
      previews;  ///< with their prompts; empty: nothing ever threatened
};

/// Plays the encounter in lockstep, without memory, taking note of the first question.
[[nodiscard]] Result<FirstQuestion> first_question(const ScenarioInputs& inputs,
                                                   const preview::ForecastTools& tools,
                                                   Clock& clock);

}  // namespace saca::app
