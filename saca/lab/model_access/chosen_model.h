#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/model_access/open_model.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/replay_model.h"

namespace saca::model_access {

/// A model as `--llm` names it, and whoever writes down what it says.
class ChosenModel {
 public:
  /// @param choice  as open_model() takes it
  /// @param record  file for its replies; empty: none
  /// @return        without a model when it is off, or when "local" is not there: see missing()
  [[nodiscard]] static Result<ChosenModel> open(const ModelSources& sources,
                                                const std::string& choice,
                                                const std::string& record, runtime::Pace pace,
                                                Clock& clock);

  /// nullptr: off.
  [[nodiscard]] language_model::LanguageModel* get() const;
  /// Why there is no model although "local" was chosen: work goes on without.
  [[nodiscard]] const std::optional<Error>& missing() const { return missing_; }
  /// Writes the replies that were to be recorded, if any.
  [[nodiscard]] std::optional<Error> save_replies() const;

 private:
  std::unique_ptr<language_model::LanguageModel> model_;
  std::unique_ptr<language_model::RecordingModel> recording_;
  std::filesystem::path record_;
  std::optional<Error> missing_;
};

}  // namespace saca::model_access
