#include "saca/lab/paper_comparison/reply_timing.h"

#include <algorithm>
#include <utility>

namespace saca::paper_comparison {
namespace {

using Kind = language_model::Answer::Kind;

/// Keeps the first question, and never answers.
class Listening final : public language_model::LanguageModel {
 public:
  [[nodiscard]] std::string description() const override { return "nobody"; }
  [[nodiscard]] const language_model::Question& first() const { return first_; }

 private:
  [[nodiscard]] Result<std::vector<language_model::Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time /*deadline*/,
      const std::function<void(const language_model::Progress&)>& /*progress*/,
      const language_model::AskOptions& options) override {
    if (first_.scenes.empty()) {
      first_ = {scenes, options.grammars};
    }
    return Error{Error::Code::too_late, "nobody answers"};
  }

  language_model::Question first_;
};

}  // namespace

std::vector<FirstQuestion> first_questions(std::span<const eval::SuiteEncounter> encounters,
                                           const eval::SuiteOptions& options,
                                           const runtime::PlanesSetup& saca,
                                           const intent::Model& intent) {
  eval::SuiteOptions alone = options;
  alone.methods = {"saca"};
  std::vector<FirstQuestion> questions;
  for (const eval::SuiteEncounter& encounter : encounters) {
    Listening listening;
    runtime::PlanesSetup setup = saca;
    setup.memory = nullptr;
    setup.model = &listening;
    eval::SuiteEncounter with_risk = encounter;
    with_risk.twin.reset();
    const eval::Comparison played = run_encounter(with_risk, alone, setup, intent).risk;
    if (!listening.first().scenes.empty() && played.woke && played.trigger) {
      questions.push_back({listening.first(), *played.trigger - *played.woke});
    }
  }
  return questions;
}

Result<ReplyTimes> timed_replies(language_model::LanguageModel& model, const Clock& clock,
                                 std::span<const FirstQuestion> questions, double patience,
                                 const std::stop_token& stop) {
  ReplyTimes times;
  std::vector<std::optional<double>> tokens;
  std::vector<std::optional<double>> seconds;
  for (const auto& [question, window] : questions) {
    if (stop.stop_requested()) {
      break;
    }
    const Clock::Time begin = clock.now();
    const auto replies = model.ask(question.scenes, begin + from_seconds(patience),
                                   [](const language_model::Progress&) {},
                                   {.stop = stop, .grammars = question.grammars});
    times.asked += static_cast<int>(question.scenes.size());
    if (!replies.has_value()) {
      if (replies.error().code == Error::Code::too_late) {
        continue;
      }
      return replies.error();
    }
    int done = 0;
    double tokens_of_them = 0.0;
    double seconds_of_them = 0.0;
    for (const language_model::Reply& reply : replies.value()) {
      if (reply.answers.empty() || reply.answers.back().kind == Kind::first) {
        continue;
      }
      const double took = to_seconds(reply.answers.back().time - begin);
      ++done;
      times.ended += reply.answers.back().kind == Kind::ended ? 1 : 0;
      times.in_time += took <= window ? 1 : 0;
      times.least_seconds = std::min(times.least_seconds.value_or(took), took);
      tokens_of_them += reply.reply_tokens;
      seconds_of_them += took;
    }
    times.done += done;
    if (done > 0) {
      tokens.emplace_back(tokens_of_them / done);
      seconds.emplace_back(seconds_of_them / done);
    }
  }
  times.tokens = eval::mean_over_encounters(tokens, 1);
  times.seconds = eval::mean_over_encounters(seconds, 1);
  return times;
}

}  // namespace saca::paper_comparison
