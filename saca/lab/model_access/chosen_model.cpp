#include "saca/lab/model_access/chosen_model.h"

#include <utility>

namespace saca::model_access {

Result<ChosenModel> ChosenModel::open(const ModelSources& sources, const std::string& choice,
                                      const std::string& record, runtime::Pace pace, Clock& clock) {
  auto model = open_model(sources, choice, pace, clock);
  ChosenModel chosen;
  if (model.has_value()) {
    chosen.model_ = std::move(model).value();
  } else if (choice == "local") {
    chosen.missing_ = model.error();
  } else {
    return model.error();
  }
  if (chosen.model_ && !record.empty()) {
    chosen.recording_ = std::make_unique<language_model::RecordingModel>(*chosen.model_, clock);
    chosen.record_ = record;
  }
  return chosen;
}

language_model::LanguageModel* ChosenModel::get() const {
  return recording_ ? recording_.get() : model_.get();
}

std::optional<Error> ChosenModel::save_replies() const {
  return recording_ ? recording_->write(record_) : std::nullopt;
}

}  // namespace saca::model_access
