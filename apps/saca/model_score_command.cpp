#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/first_question.h"
#include "apps/saca/model.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/progress.h"
#include "apps/saca/surveying.h"
#include "saca/core/journal.h"
#include "saca/decide/check.h"
#include "saca/eval/choices.h"
#include "saca/memory/similarity.h"
#include "saca/preview/policy_facts.h"
#include "saca/reason/reply.h"
#include "saca/reason/truth.h"

namespace saca::app {
namespace {

using eval::Finding;
using eval::Probabilities;
using manoeuvre::PolicyId;
using nlohmann::json;

struct ScoreOptions {
  SurveyOptions survey;
  std::string model = "local";
  bool as_json = false;
};

/// What was said about one prompt.
struct Said {
  Probabilities first{};  ///< at once
  Probabilities last{};   ///< after reasoning
  bool ended = false;     ///< the text came to its end by itself
  int checked = 0;        ///< statements
  int wrong = 0;
  bool unfounded = false;  ///< the choice rests on something false
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Said, first, last, ended, checked, wrong, unfounded)

/// One encounter in which a model was asked.
struct Score {
  Finding finding;
  PolicyId by_forecast{};  ///< the best
  PolicyId as_saca{};      ///< the model's choice with facts, where it passes SACA's checks
  Said with_facts;
  Said without_facts;
};

PolicyId likeliest(const Probabilities& probabilities) {
  return likeliest_policy(reason::Answer{.probability = probabilities});
}

/// The prompt as the paper has it: without what was computed of each policy.
std::string without_manoeuvres(const std::string& prompt) {
  const std::size_t begin = prompt.find("## Manoeuvres:\n");
  const std::size_t end = prompt.find("## Historical Scenarios:\n");
  return prompt.substr(0, begin) + prompt.substr(end);
}

Said said_in(const reason::Reply& reply, const std::string& prompt,
             const preview::Situation& situation) {
  Said said;
  said.first = reply.answers.front().probability;
  said.last = reply.answers.back().probability;
  said.ended = reply.answers.back().kind == reason::Answer::Kind::ended;
  const reason::Truth truth =
      reason::truth_of(reply.reasoning, prompt, situation, likeliest_policy(reply.answers.back()));
  said.checked = truth.num_checked;
  said.wrong = static_cast<int>(truth.wrong.size());
  said.unfounded = truth.is_choice_unfounded();
  return said;
}

/// What SACA would have cached of it: the last answer that passes, else emergency braking.
PolicyId checked_choice(const Said& said, const preview::Situation& situation,
                        const preview::ForecastTools& tools) {
  for (const PolicyId policy : {likeliest(said.last), likeliest(said.first)}) {
    const bool strict_passes = !said.unfounded || policy != likeliest(said.last) ||
                               decide::check_unfounded(policy, situation).passed;
    if (strict_passes &&
        decide::check(situation.facts[manoeuvre::index(policy)].plan, situation, tools).passed) {
      return policy;
    }
  }
  return PolicyId::aeb;
}

/// Of the forecasts that were asked about the one that came nearest to what happened.
const decide::Preview& nearest(const FirstQuestion& asked) {
  return *std::max_element(asked.previews.begin(), asked.previews.end(),
                           [&](const decide::Preview& a, const decide::Preview& b) {
                             const auto alike = [&](const decide::Preview& one) {
                               return memory::similarity(one.situation.scene_at_trigger,
                                                         *asked.record.at_trigger);
                             };
                             return alike(a) < alike(b);
                           });
}

/// nullopt: nothing threatened, or it never came to the trigger.
Result<std::optional<Score>> score(const SuiteSource& source, std::uint64_t number,
                                   reason::LanguageModel& model, Clock& clock) {
  const auto sample = source.sample(number);
  if (!sample.has_value()) {
    return sample.error();
  }
  ScenarioInputs inputs{source.inputs(), sample.value().scenario};
  const manoeuvre::Atlas atlas = usual_atlas(inputs);
  const auto danger = usual_danger(inputs);
  if (!danger.has_value()) {
    return danger.error();
  }
  const preview::ForecastTools tools{&inputs.car, &inputs.harm, &atlas, &danger.value()};
  const auto asked = first_question(inputs, tools, clock);
  if (!asked.has_value()) {
    return asked.error();
  }
  const loop::Record& record = asked.value().record;
  if (asked.value().previews.empty() || !record.hindsight) {
    return std::optional<Score>();
  }
  const decide::Preview& preview = nearest(asked.value());
  const std::vector<std::string> prompts{preview.prompt, without_manoeuvres(preview.prompt)};
  constexpr auto patience = std::chrono::minutes(10);
  const auto replies = model.ask(prompts, clock.now() + patience, [](const reason::Progress&) {});
  if (!replies.has_value()) {
    return replies.error();
  }
  for (const reason::Reply& reply : replies.value()) {
    if (reply.answers.empty()) {
      return Error{Error::Code::malformed, model.description() +
                                               ": want an answer, got none to \"" +
                                               reply.reasoning.substr(0, 80) + "\""};
    }
  }
  Score one{.finding = eval::finding_of(record.at_trigger->time, *record.hindsight),
            .by_forecast = preview::best_by_forecast(preview.situation.facts),
            .with_facts = said_in(replies.value()[0], prompts[0], preview.situation),
            .without_facts = said_in(replies.value()[1], prompts[1], preview.situation)};
  one.finding.number = number;
  one.finding.family = source.family_of(number);
  one.as_saca = checked_choice(one.with_facts, preview.situation, tools);
  return std::optional(std::move(one));
}

std::string line_of(std::uint64_t number, const std::optional<Score>& one) {
  json line = {{"number", number}};
  if (one) {
    line["finding"] = eval::line_of(one->finding);
    line["by_forecast"] = manoeuvre::index(one->by_forecast);
    line["as_saca"] = manoeuvre::index(one->as_saca);
    line["with_facts"] = one->with_facts;
    line["without_facts"] = one->without_facts;
  }
  return line.dump();
}

/// What a journal's line holds.
struct Remembered {
  std::uint64_t number = 0;
  std::optional<Score> score;
};

Result<Remembered> remembered(const std::string& line, const std::string& path) {
  try {
    const json read = json::parse(line);
    Remembered one{.number = read.at("number").get<std::uint64_t>(), .score = {}};
    if (read.contains("finding")) {
      one.score =
          Score{.finding = eval::finding_from(read.at("finding").get<std::string>()).value(),
                .by_forecast = manoeuvre::policy_from(read.at("by_forecast").get<int>()).value(),
                .as_saca = manoeuvre::policy_from(read.at("as_saca").get<int>()).value(),
                .with_facts = read.at("with_facts").get<Said>(),
                .without_facts = read.at("without_facts").get<Said>()};
    }
    return one;
  } catch (const std::exception& problem) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want a line of `saca model score`, got \"{}\": {}", path,
                             line.substr(0, 80), problem.what())};
  }
}

/// Asks in one encounter after the other until enough were asked about.
/// @return  nullopt: interrupted
Result<std::optional<std::vector<Score>>> score_all(const SuiteSource& source,
                                                    reason::LanguageModel& model,
                                                    const ScoreOptions& options) {
  const std::string path = options.survey.journal.empty()
                               ? fmt::format("runs/model-score-{}-{}.journal", options.survey.suite,
                                             options.survey.split)
                               : options.survey.journal;
  if (auto problem = make_folder_of(path)) {
    return *problem;
  }
  const auto journal =
      Journal::open(path, fmt::format("saca {} model score of {} in {}, {} split, {} ({:016x})",
                                      SACA_VERSION, model.description(), options.survey.suite,
                                      options.survey.split, options.survey.car, source.digest()));
  if (!journal.has_value()) {
    return journal.error();
  }
  const auto count = static_cast<std::size_t>(options.survey.count);
  std::vector<Score> scores;
  std::uint64_t number = 0;
  for (const std::string& line : journal.value().lines()) {
    const auto one = remembered(line, path);
    if (!one.has_value()) {
      return one.error();
    }
    number = one.value().number + 1;
    if (one.value().score && scores.size() < count) {
      scores.push_back(*one.value().score);
    }
  }
  watch_for_interrupt();
  SteadyClock clock;
  ProgressLine progress("asking " + model.description(), options.survey.count, clock);
  const int before = static_cast<int>(scores.size());
  for (; scores.size() < count; ++number) {
    if (interrupted()) {
      return std::optional<std::vector<Score>>();
    }
    const auto one = score(source, number, model, clock);
    if (!one.has_value()) {
      return one.error();
    }
    if (!journal.value().add(line_of(number, one.value()))) {
      return Error{Error::Code::unwritable, path + ": cannot be added to"};
    }
    if (one.value()) {
      scores.push_back(*one.value());
      progress.show(static_cast<int>(scores.size()), before, " encounters");
    }
  }
  return std::optional(std::move(scores));
}

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
  int ended = 0;
  int checked = 0;
  int wrong = 0;
  int unfounded = 0;
  for (const Score& one : scores) {
    const Said& said = one.*which;
    ended += said.ended ? 1 : 0;
    checked += said.checked;
    wrong += said.wrong;
    unfounded += said.unfounded ? 1 : 0;
  }
  const auto num = static_cast<double>(scores.size());
  return {{"ended_share", ended / num},
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
        "\n{}: {:.0f} % of the replies end by themselves; of {} statements that can be checked {} "
        "are "
        "true; {:.0f} % of the choices rest on something false",
        std::string_view(key) == "with_facts" ? "With facts" : "Without",
        100.0 * talk["ended_share"].get<double>(), talk["statements_checked"].get<int>(),
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
  const auto model = ChosenModel::open(source.value().inputs().places, options.model, "",
                                       loop::Pace::lockstep, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  if (model.value().get() == nullptr) {
    complain("without a language model nothing can be asked");
    return bad_input;
  }
  const auto scores = score_all(source.value(), *model.value().get(), options);
  if (!scores.has_value()) {
    return refused(scores.error());
  }
  if (!scores.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const json document = document_of(*scores.value(), options, model.value().get()->description());
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
