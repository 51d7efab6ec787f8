#pragma once

#include <vector>

#include "apps/saca/inputs.h"
#include "saca/loop/encounter.h"

namespace saca::app {

/// An encounter that was played without a model, and what one would first have been asked in it.
struct FirstQuestion {
  loop::Record record;
  std::vector<decide::Preview> previews;  ///< with their prompts; empty: nothing ever threatened
};

/// Plays the encounter in lockstep, without memory, taking note of the first question.
[[nodiscard]] Result<FirstQuestion> first_question(const ScenarioInputs& inputs,
                                                   const preview::ForecastTools& tools,
                                                   Clock& clock);

}  // namespace saca::app
