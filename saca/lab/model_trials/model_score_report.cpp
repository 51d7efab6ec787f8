#include "saca/lab/model_trials/model_score_report.h"

#include <fmt/core.h>

#include <optional>
#include <string_view>

#include "saca/lab/eval/estimate_text.h"

namespace saca::model_trials {

using encounter::ThinkingFigures;
using eval::Estimate;
using eval::MethodFigures;
using eval::ModelScore;
using eval::with_interval;
using nlohmann::json;

namespace {

json interval_of(const Estimate& estimate) {
  return {
      {"mean", estimate.value}, {"low", estimate.low}, {"high", estimate.high}, {"n", estimate.n}};
}

/// Of what was said, beside what was carried out; nullopt: of nothing.
struct TalkShares {
  std::optional<double> answered;
  std::optional<double> ended;      ///< of the answered
  std::optional<double> is_true;    ///< of the statements
  std::optional<double> unfounded;  ///< of the answered
};

TalkShares shares_of(const ThinkingFigures& said) {
  const auto share = [](int part, int of) {
    return of > 0 ? std::optional(static_cast<double>(part) / of) : std::nullopt;
  };
  return {.answered = share(said.answered, said.asked),
          .ended = share(said.ended, said.answered),
          .is_true = share(said.statements - said.false_statements, said.statements),
          .unfounded = share(said.unfounded, said.answered)};
}

json talk_json(const ThinkingFigures& said) {
  const auto share = [](const std::optional<double>& one) { return one ? json(*one) : json(); };
  const TalkShares shares = shares_of(said);
  return {{"asked", said.asked},
          {"answered_share", share(shares.answered)},
          {"ended_share", share(shares.ended)},
          {"statements_checked", said.statements},
          {"statements_true_share", share(shares.is_true)},
          {"unfounded_share", share(shares.unfounded)}};
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.0f} %", 100.0 * *share) : "none";
}

std::string talk_text(std::string_view prompts, const ThinkingFigures& said) {
  const TalkShares shares = shares_of(said);
  return fmt::format(
      "\n{}: of {} forecasts asked about {} got an answer in time, {} of these replies end by "
      "themselves; of {} statements that can be checked {} are true; {} of the choices rest on "
      "something false",
      prompts, said.asked, percent(shares.answered), percent(shares.ended), said.statements,
      percent(shares.is_true), percent(shares.unfounded));
}

/// What was said where a choice is made by reasoning.
ThinkingFigures said_in(const ModelScore& score, std::string_view key) {
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    if (eval::scored_choices()[i].key == key) {
      return score.choices[i].thinking.value_or(ThinkingFigures{});
    }
  }
  return {};
}

std::string choice_text(const MethodFigures& one, std::string_view title) {
  const auto by_model = one.sources.find("model");
  return fmt::format("{:36} {:>22} {:>26} {:9.1f} {:>11} {:9}\n", title,
                     with_interval(one.right, 1, 100.0), with_interval(one.regret, 4),
                     100.0 * one.contact.value,
                     one.needless.n == 0 ? "-" : fmt::format("{:.1f}", 100.0 * one.needless.value),
                     by_model == one.sources.end() ? 0 : by_model->second);
}

}  // namespace

json model_score_json(const ModelScore& score, const std::string& command,
                      const std::string& model) {
  json document = {{"schema", "saca.model_score/2"},
                   {"command", command},
                   {"model", model},
                   {"encounters", score.choices.front().harm.n},
                   {"choices", json::object()},
                   {"with_facts", talk_json(said_in(score, "facts_reasoned"))},
                   {"without_facts", talk_json(said_in(score, "no_facts_reasoned"))}};
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    const MethodFigures& figures = score.choices[i];
    document["choices"][std::string(eval::scored_choices()[i].key)] = {
        {"method", figures.method},
        {"right", interval_of(figures.right)},
        {"harm", interval_of(figures.harm)},
        {"regret", interval_of(figures.regret)},
        {"contact", interval_of(figures.contact)},
        {"needless", interval_of(figures.needless)},
        {"sources", figures.sources}};
  }
  if (const auto& calibration = score.calibration) {
    document["temperature"] = {{"best", calibration->temperature},
                               {"log_loss", calibration->log_loss},
                               {"log_loss_as_it_is", calibration->log_loss_now},
                               {"n", calibration->count}};
  }
  return document;
}

std::string model_score_text(const ModelScore& score, const std::string& model) {
  std::string text =
      fmt::format("{} encounters, {}; means with 95 % intervals of what was carried out\n\n",
                  score.choices.front().harm.n, model);
  text += fmt::format("{:36} {:>22} {:>26} {:>9} {:>11} {:>9}\n", "choice",
                      "as good as the best, %", "regret", "contact,%", "needless,%", "by model");
  for (std::size_t i = 0; i < score.choices.size(); ++i) {
    text += choice_text(score.choices[i], eval::scored_choices()[i].title);
  }
  text += talk_text("With facts", said_in(score, "facts_reasoned"));
  text += talk_text("Without", said_in(score, "no_facts_reasoned")) + "\n";
  if (const auto& calibration = score.calibration) {
    text += fmt::format("Temperature: {:.2f} (log loss {:.3f}, as it is {:.3f}; {} encounters)\n",
                        calibration->temperature, calibration->log_loss, calibration->log_loss_now,
                        calibration->count);
  }
  return text;
}

}  // namespace saca::model_trials
