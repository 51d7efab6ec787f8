#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "apps/saca/places.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/model_access/chosen_model.h"
#include "saca/lab/model_access/open_model.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::app {

// Language models as saca/lab/model_access opens them, with the program's own files; the key of a
// server is in the environment as SACA_LLM_KEY.

[[nodiscard]] Result<std::unique_ptr<language_model::ChildModel>> open_local_model(
    const Places& places, runtime::Pace pace, Clock& clock);

[[nodiscard]] Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(
    const Places& places, const std::string& choice, runtime::Pace pace, Clock& clock,
    std::string_view option = "--llm");

/// That "local" is not there is said on the error stream, and the run goes on without.
/// @param record  file for its replies; empty: none
[[nodiscard]] Result<model_access::ChosenModel> open_chosen_model(const Places& places,
                                                                  const std::string& choice,
                                                                  const std::string& record,
                                                                  runtime::Pace pace, Clock& clock);

}  // namespace saca::app
