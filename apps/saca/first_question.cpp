#include "apps/saca/first_question.h"

#include <algorithm>
#include <string>
#include <utility>

#include "saca/thinking/arbitration/event.h"

namespace saca::app {
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

Result<FirstQuestion> first_question(const ScenarioInputs& inputs,
                                     const preview::ForecastTools& tools, Clock& clock) {
  QuestionTaker taker;
  encounter::Silence silence;
  const encounter::Setup setup{.scenario = &inputs.scenario,
                               .car = &inputs.car,
                               .harm = &inputs.harm,
                               .intent = &inputs.intent,
                               .atlas = tools.atlas,
                               .danger = tools.danger,
                               .cues = tools.cues,
                               .pace = runtime::Pace::lockstep,
                               .costs = {},
                               .model = &taker,
                               .clock = &clock};
  auto record = encounter::run(setup, silence);
  if (!record.has_value()) {
    return record.error();
  }
  FirstQuestion asked{.record = std::move(record).value(), .previews = {}};
  const auto& all = asked.record.previews;  // numbered as they were asked about
  asked.previews.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(
                                                       std::min(all.size(), taker.num_first())));
  for (arbitration::Preview& preview : asked.previews) {  // forecast anew since then
    preview.prompt = arbitration::prompt_of(preview);
  }
  return asked;
}

}  // namespace saca::app
