#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/saca/model.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/model_scoring.h"

namespace saca::app {
namespace {

using eval::Finding;
using eval::Probabilities;
using manoeuvre::PolicyId;
using nlohmann::json;

/// One way to choose, over all encounters.
struct Row {
  std::string_view key;
  std::string_view words;
  PolicyId (*choice)(const Score& score);
};

constexpr std::array<Row, 8> rows{
    {{"facts_at_once", "the model, at once",
      [](const Score& s) { return likeliest(s.with_facts.first); }},
     {"facts_reasoned", "the model, after reasoning",
      [](const Score& s) { return likeliest(s.with_facts.last); }},
     {"facts_checked", "the same, checked as SACA does", [](const Score& s) { return s.as_saca; }},
     {"no_facts_at_once", "without our facts, at once",
      [](const Score& s) { return likeliest(s.without_facts.first); }},
     {"no_facts_reasoned", "without our facts, after reasoning",
      [](const Score& s) { return likeliest(s.without_facts.last); }},
     {"best_by_forecast", "the best forecast", [](const Score& s) { return s.by_forecast; }},
     {"always_aeb", "always AEB", [](const Score&) { return PolicyId::aeb; }},
     {"best_in_hindsight", "the best in hindsight",
      [](const Score& s) { return s.finding.best; }}}};

std::vector<Finding> findings_of(const std::vector<Score>& scores) {
  std::vector<Finding> all(scores.size());
  std::transform(scores.begin(), scores.end(), all.begin(),
                 [](const Score& one) { return one.finding; });
  return all;
}

eval::ChoiceFigures figures_of(const Row& row, const std::vector<Score>& scores) {
  std::vector<PolicyId> choices(scores.size());
  std::transform(scores.begin(), scores.end(), choices.begin(), row.choice);
  return eval::figures_of(findings_of(scores), choices);
}

/// What was said, beside what was chosen.
json talk_of(const std::vector<Score>& scores, const Said Score::*which) {
  int valid = 0;
  int ended = 0;
  int checked = 0;
  int wrong = 0;
  int unfounded = 0;
  for (const Score& one : scores) {
    const Said& said = one.*which;
    valid += said.valid ? 1 : 0;
    ended += said.ended ? 1 : 0;
    checked += said.checked;
    wrong += said.wrong;
    unfounded += said.unfounded ? 1 : 0;
  }
  const auto num = static_cast<double>(scores.size());
  return {{"valid_share", valid / num},
          {"ended_share", ended / num},
          {"statements_checked", checked},
          {"statements_true_share",
           checked > 0 ? json(1.0 - static_cast<double>(wrong) / checked) : json()},
          {"unfounded_share", unfounded / num}};
}

json document_of(const std::vector<Score>& scores, const ScoreOptions& options,
                 const std::string& description) {
  json document = {{"schema", "saca.model_score/1"},
                   {"command", command_line(options.survey, "model score")},
                   {"model", description},
                   {"encounters", scores.size()},
                   {"choices", json::object()}};
  const auto interval = [](const outcome::Mean& mean) {
    return json{{"mean", mean.value}, {"low", mean.low}, {"high", mean.high}};
  };
  const auto share = [](const Proportion& of) {
    return json{{"share", of.share}, {"low", of.low}, {"high", of.high}};
  };
  for (const Row& row : rows) {
    const eval::ChoiceFigures figures = figures_of(row, scores);
    document["choices"][std::string(row.key)] = {{"right", share(figures.right)},
                                                 {"harm", interval(figures.harm)},
                                                 {"regret", interval(figures.regret)},
                                                 {"contact", share(figures.contact)},
                                                 {"quiet", figures.quiet},
                                                 {"needless", figures.needless}};
  }
  document["with_facts"] = talk_of(scores, &Score::with_facts);
  document["without_facts"] = talk_of(scores, &Score::without_facts);
  std::vector<Probabilities> said(scores.size());
  std::transform(scores.begin(), scores.end(), said.begin(),
                 [](const Score& one) { return one.with_facts.last; });
  const std::vector<Finding> findings = findings_of(scores);
  const double temperature = eval::best_temperature(findings, said);
  document["temperature"] = {{"best", temperature},
                             {"log_loss", eval::log_loss(findings, said, temperature)},
                             {"log_loss_as_it_is", eval::log_loss(findings, said, 1.0)}};
  return document;
}

void print(const json& document) {
  fmt::print("{} encounters, {}\n\n{:36} {:>22} {:>26} {:>9} {:>14}\n",
             document["encounters"].get<int>(), document["model"].get<std::string>(), "choice",
             "best in hindsight", "regret", "contact", "needless");
  for (const Row& row : rows) {
    const json& one = document["choices"][std::string(row.key)];
    const auto percent = [](const json& of) { return 100.0 * of.get<double>(); };
    fmt::print(
        "{:36} {:5.1f} % ({:4.1f} to {:4.1f}) {:8.4f} ({:.4f} to {:.4f}) {:7.1f} % {:6} of {:3}\n",
        row.words, percent(one["right"]["share"]), percent(one["right"]["low"]),
        percent(one["right"]["high"]), one["regret"]["mean"].get<double>(),
        one["regret"]["low"].get<double>(), one["regret"]["high"].get<double>(),
        percent(one["contact"]["share"]), one["needless"].get<int>(), one["quiet"].get<int>());
  }
  for (const char* key : {"with_facts", "without_facts"}) {
    const json& talk = document[key];
    fmt::print(
        "\n{}: {:.0f} % of the replies hold an answer, {:.0f} % end by themselves; of {} "
        "statements that can be checked {} "
        "are "
        "true; {:.0f} % of the choices rest on something false",
        std::string_view(key) == "with_facts" ? "With facts" : "Without",
        100.0 * talk["valid_share"].get<double>(), 100.0 * talk["ended_share"].get<double>(),
        talk["statements_checked"].get<int>(),
        talk["statements_true_share"].is_null()
            ? "none"
            : fmt::format("{:.0f} %", 100.0 * talk["statements_true_share"].get<double>()),
        100.0 * talk["unfounded_share"].get<double>());
  }
  fmt::print("\nTemperature: {:.2f} (log loss {:.3f}, as it is {:.3f})\n",
             document["temperature"]["best"].get<double>(),
             document["temperature"]["log_loss"].get<double>(),
             document["temperature"]["log_loss_as_it_is"].get<double>());
}

int model_score(const ScoreOptions& options) {
  const auto source = SuiteSource::open(options.survey, "model score");
  if (!source.has_value()) {
    return refused(source.error());
  }
  SteadyClock clock;
  const auto model =
      open_needed_model(source.value().inputs().places, options.model, loop::Pace::lockstep, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const auto scores = score_all(source.value(), *model.value(), options);
  if (!scores.has_value()) {
    return refused(scores.error());
  }
  if (!scores.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const json document = document_of(*scores.value(), options, model.value()->description());
  if (options.as_json) {
    fmt::print("{}\n", document.dump(1, ' ', false, json::error_handler_t::replace));
  } else {
    print(document);
  }
  return success;
}

}  // namespace

void add_model_score(CLI::App& model, int& exit_code) {
  CLI::App* const command = model.add_subcommand("score",
                                                 "How well it chooses in a suite of encounters, "
                                                 "with and without our facts; can be interrupted");
  const auto options = std::make_shared<ScoreOptions>();
  options->survey.count = 300;
  options->survey.split = "calibration";
  add_survey_options(*command, options->survey);
  command->get_option("--count")->check(CLI::Range(2, 10'000'000));
  command->remove_option(command->get_option("--threads"));  // one question at a time
  command->add_option("--llm", options->model, "As of `saca reason`")->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = model_score(*options); });
}

}  // namespace saca::app
