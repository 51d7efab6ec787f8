#include "saca/lab/model_trials/first_question.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

namespace saca::model_trials {
namespace {

/// Takes the first question of an encounter and answers none.
class QuestionTaker final : public language_model::LanguageModel {
 public:
  [[nodiscard]] std::string description() const override { return "question taker"; }
  [[nodiscard]] std::size_t num_first() const { return num_first_; }

 private:
  [[nodiscard]] Result<std::vector<language_model::Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time,
      const std::function<void(const language_model::Progress&)>&,
      const language_model::AskOptions&) override {
    if (num_first_ == 0) {
      num_first_ = scenes.size();
    }
    return Error{Error::Code::too_late, "only listened to"};
  }

  std::size_t num_first_ = 0;
};

}  // namespace

Result<std::vector<arbitration::Preview>> first_question(encounter::Setup setup) {
  QuestionTaker taker;
  encounter::Silence silence;
  setup.pace = runtime::Pace::lockstep;
  setup.costs = {};
  setup.memory = nullptr;
  setup.model = &taker;
  auto record = encounter::run(setup, silence);
  if (!record.has_value()) {
    return record.error();
  }
  // Numbered as they were asked about.
  std::vector<arbitration::Preview> previews = std::move(record).value().previews;
  previews.resize(std::min(previews.size(), taker.num_first()));
  for (arbitration::Preview& preview : previews) {  // forecast anew since then
    preview.prompt = arbitration::prompt_of(preview);
  }
  return previews;
}

}  // namespace saca::model_trials
