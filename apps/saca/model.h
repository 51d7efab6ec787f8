#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "apps/saca/places.h"
#include "saca/core/clock.h"
#include "saca/core/result.h"
#include "saca/reason/language_model.h"

namespace saca::app {

/// The model that `--llm` names.
///
/// @param choice  "local", "off" or "replay:FILE"
/// @param record  file to write its replies to afterwards; empty: none
/// @return        nullptr when it is off, or when "local" is not there: that is said on the error
///                stream, and the run goes on without
[[nodiscard]] Result<std::unique_ptr<reason::LanguageModel>> open_model(
    const Places& places, const std::string& choice, const std::string& record, Clock& clock);

}  // namespace saca::app
