#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::model_access {

/// What language models are opened with.
struct ModelSources {
  std::filesystem::path host;          ///< program that runs local weights; may be missing
  std::filesystem::path choice;        ///< choice.json of `make model`; may be missing
  std::filesystem::path harm;          ///< data/harm.toml, of which the prompt tells
  std::filesystem::path temperatures;  ///< data/language_model.toml
  std::string key;                     ///< of servers; empty: none
};

/// The model of `make model` in its own process, ready for questions. At real pace it gives way to
/// whoever else wants the cores; in lockstep a reply does not depend on what else the machine does.
/// @return  an error that says what is missing and how to get it
[[nodiscard]] Result<std::unique_ptr<language_model::ChildModel>> open_local_model(
    const ModelSources& sources, runtime::Pace pace, Clock& clock);

/// A model as `--llm` names it.
/// @param choice  "local", "local:FILE" (other weights), "off", "replay:FILE" or "MODEL@URL": a
///                server with /v1/chat/completions
/// @return        nullptr where it is off; malformed where it is none of these
[[nodiscard]] Result<std::unique_ptr<language_model::LanguageModel>> open_model(
    const ModelSources& sources, const std::string& choice, runtime::Pace pace, Clock& clock);

/// Likewise for work that is nothing without one.
/// @param option  that named it, for messages
/// @return        never nullptr; an error where it is off or not there
[[nodiscard]] Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(
    const ModelSources& sources, const std::string& choice, runtime::Pace pace, Clock& clock,
    std::string_view option);

}  // namespace saca::model_access
