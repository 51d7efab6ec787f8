#pragma once

#include <memory>
#include <string>

#include "apps/saca/places.h"
#include "saca/core/clock.h"
#include "saca/core/result.h"
#include "saca/reason/child_model.h"
#include "saca/reason/language_model.h"

namespace saca::app {

/// The model of `make model` in its own process, ready for questions.
/// @return  an error that says what is missing and how to get it
[[nodiscard]] Result<std::unique_ptr<reason::ChildModel>> open_local_model(const Places& places,
                                                                           Clock& clock);

/// The model that `--llm` names.
///
/// @param choice  "local", "off" or "replay:FILE"
/// @return        nullptr when it is off, or when "local" is not there: that is said on the error
///                stream, and the run goes on without
[[nodiscard]] Result<std::unique_ptr<reason::LanguageModel>> open_model(const Places& places,
                                                                        const std::string& choice,
                                                                        Clock& clock);

}  // namespace saca::app
