#include "saca/lab/model_trials/reason_report.h"

#include <fmt/core.h>

#include <utility>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/explanation_json.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth_json.h"

namespace saca::model_trials {

using language_model::Answer;
using manoeuvre::PolicyId;
using nlohmann::json;

namespace {

double milliseconds(Clock::Time time) {
  return 1e3 * to_seconds(time);
}

json considered_json(const ForecastReply& one) {
  json answers = json::array();
  for (const Answer& answer : one.reply.answers) {
    answers.push_back({{"after_ms", milliseconds(answer.time)},
                       {"kind", name(answer.kind)},
                       {"policy", manoeuvre::index(likeliest_policy(answer))},
                       {"probability", answer.probability}});
  }
  return {{"probability", one.preview->situation.probability},
          {"trigger_s", one.preview->situation.scene_at_trigger.time},
          {"prompt", one.preview->prompt},
          {"reasoning", one.reply.reasoning},
          {"answers", answers},
          {"prompt_tokens", one.reply.prompt_tokens},
          {"reply_tokens", one.reply.reply_tokens},
          {"truth", truth_json(one.truth)},
          {"explanation", explanation_json(one.explanation)},
          {"check",
           one.check ? json{{"passed", one.check->passed}, {"text", one.check->text}} : json()}};
}

std::string answers_text(const std::vector<Answer>& answers) {
  std::string text = fmt::format("{:>9} {:>7}", "after", "answer");
  for (const PolicyId policy : manoeuvre::all_policies) {
    text += fmt::format(" {:>7}", name(policy));
  }
  text += '\n';
  for (const Answer& answer : answers) {
    text += fmt::format("{:>6.0f} ms {:>7}", milliseconds(answer.time), name(answer.kind));
    for (const double p : answer.probability) {
      text += fmt::format(" {:>5.0f} %", 100.0 * p);
    }
    text += '\n';
  }
  return text;
}

std::string truth_text(const language_model::Truth& truth) {
  const auto num_checked = static_cast<std::size_t>(truth.num_checked);
  std::string text = fmt::format("Truth: {} of {} statements that can be checked.\n",
                                 num_checked - truth.wrong.size(), num_checked);
  for (const language_model::FalseStatement& each : truth.wrong) {
    text +=
        fmt::format("  false{}: \"{}\": {}\n",
                    each.load_bearing ? ", and the choice rests on it" : "", each.text, each.why);
  }
  return text;
}

std::string explanation_text(const language_model::Explanation& explanation) {
  const std::string in_try =
      explanation.tries > 1 ? fmt::format(", try {}", explanation.tries) : "";
  return fmt::format("Reasons, {}{}:\n{}",
                     explanation.from == language_model::Explanation::From::facts
                         ? "by the figures"
                         : "as far as true",
                     in_try, explanation.text);
}

std::string reply_text(std::size_t number, const ForecastReply& one, ReasoningText reasoning) {
  std::string text = fmt::format("--- Forecast {} ---\n", number);
  if (reasoning == ReasoningText::told) {
    text += one.reply.reasoning + "\n";
  }
  text += answers_text(one.reply.answers) + truth_text(one.truth);
  if (one.reply.answers.empty()) {
    return text + "No answer in time.\n\n";
  }
  const PolicyId chosen = likeliest_policy(one.reply.answers.back());
  if (one.explanation) {
    text += explanation_text(*one.explanation);
  }
  return text + fmt::format("Choice: {} {}; rollout check {}: {}.\n{} tokens read, {} written.\n\n",
                            manoeuvre::index(chosen), name(chosen),
                            one.check->passed ? "passed" : "failed", one.check->text,
                            one.reply.prompt_tokens, one.reply.reply_tokens);
}

}  // namespace

json reason_json(const ReasonRequest& request, const std::vector<ForecastReply>& replies) {
  json forecasts = json::array();
  for (const ForecastReply& one : replies) {
    forecasts.push_back(considered_json(one));
  }
  return {{"schema", "saca.reason/1"}, {"scenario", request.scenario},
          {"model", request.model},    {"deadline_ms", request.deadline},
          {"system", request.system},  {"forecasts", std::move(forecasts)}};
}

std::string question_text(const std::vector<arbitration::Preview>& previews) {
  std::string text;
  for (const arbitration::Preview& preview : previews) {
    const preview::Situation& situation = preview.situation;
    text += fmt::format("--- Forecast {} of {}: {:.0f} % likely, trigger at {:.2f} s ---\n{}\n",
                        preview.number + 1, previews.size(), 100.0 * situation.probability,
                        situation.scene_at_trigger.time, preview.prompt);
  }
  return text;
}

std::string replies_text(const std::vector<ForecastReply>& replies, ReasoningText reasoning) {
  if (replies.empty()) {
    return "Nothing threatens in this scenario: there is nothing to ask.\n";
  }
  std::string text;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    text += reply_text(i + 1, replies[i], reasoning);
  }
  return text;
}

}  // namespace saca::model_trials
