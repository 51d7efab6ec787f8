#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "apps/saca/places.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/replay_model.h"

namespace saca::app {

/// The model of `make model` in its own process, ready for questions. At real pace it gives way to
/// whoever else wants the cores; in lockstep a reply does not depend on what else the machine does.
/// @return  an error that says what is missing and how to get it
[[nodiscard]] Result<std::unique_ptr<language_model::ChildModel>> open_local_model(
    const Places& places, runtime::Pace pace, Clock& clock);

/// A model as `--llm` names it, for commands that are nothing without one.
/// @param option  that named it, for messages
/// @return        never nullptr; an error where it is off or not there
[[nodiscard]] Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(
    const Places& places, const std::string& choice, runtime::Pace pace, Clock& clock,
    std::string_view option = "--llm");

/// A model as `--llm` names it, and whoever writes down what it says.
class ChosenModel {
 public:
  /// @param choice  "local", "local:FILE" (other weights), "off", "replay:FILE" or "MODEL@URL": a
  /// server with
  ///                /v1/chat/completions, its key in the environment as SACA_LLM_KEY
  /// @param record  file for its replies; empty: none
  /// @return        without a model when it is off, or when "local" is not there: that is said on
  ///                the error stream, and the run goes on without
  [[nodiscard]] static Result<ChosenModel> open(const Places& places, const std::string& choice,
                                                const std::string& record, runtime::Pace pace,
                                                Clock& clock);

  /// nullptr: off.
  [[nodiscard]] language_model::LanguageModel* get() const;
  /// Writes the replies that were to be recorded, if any.
  [[nodiscard]] std::optional<Error> save_replies() const;

 private:
  std::unique_ptr<language_model::LanguageModel> model_;
  std::unique_ptr<language_model::RecordingModel> recording_;
  std::filesystem::path record_;
};

}  // namespace saca::app
