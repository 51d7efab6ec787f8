#include "apps/saca/model_scoring.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/saca/atlas_making.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/first_question.h"
#include "apps/saca/progress.h"
#include "saca/core/journal.h"
#include "saca/decide/check.h"
#include "saca/memory/similarity.h"
#include "saca/preview/policy_facts.h"
#include "saca/reason/reply.h"
#include "saca/reason/truth.h"

namespace saca::app {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Said, first, last, ended, checked, wrong, unfounded, valid)

namespace {

using manoeuvre::PolicyId;
using nlohmann::json;

/// The prompt as the paper has it: without what was computed of each policy.
std::string without_manoeuvres(const std::string& prompt) {
  const std::size_t begin = prompt.find("## Manoeuvres:\n");
  const std::size_t end = prompt.find("## Historical Scenarios:\n");
  return prompt.substr(0, begin) + prompt.substr(end);
}

Said said_in(const reason::Reply& reply, const std::string& prompt,
             const preview::Situation& situation) {
  Said said;
  if (reply.answers.empty()) {
    said.valid = false;
    said.first.fill(1.0 / manoeuvre::num_policies);
    said.last = said.first;
    return said;
  }
  said.first = reply.answers.front().probability;
  said.last = reply.answers.back().probability;
  said.ended = reply.answers.back().kind == reason::Answer::Kind::ended;
  const reason::Truth truth = reason::truth_of(reply, prompt, situation);
  said.checked = truth.num_checked;
  said.wrong = static_cast<int>(truth.wrong.size());
  said.unfounded = truth.is_choice_unfounded();
  return said;
}

/// What SACA would have cached of it (decide::ThinkingPlane): the last answer that passes, unless
/// what it rests on is false and it is not the best; else emergency braking.
PolicyId checked_choice(const Said& said, const preview::Situation& situation,
                        const preview::ForecastTools& tools) {
  PolicyId plan = PolicyId::aeb;
  for (const PolicyId policy : {likeliest(said.first), likeliest(said.last)}) {
    if (decide::check(situation.facts[manoeuvre::index(policy)].plan, situation, tools).passed) {
      plan = policy;
    }
  }
  const bool is_withdrawn = said.unfounded && plan == likeliest(said.last) &&
                            !decide::check_unfounded(plan, situation).passed;
  return is_withdrawn ? PolicyId::aeb : plan;
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
                                   reason::LanguageModel& model, Clock& clock,
                                   const std::stop_token& stop) {
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
  const auto replies =
      model.ask(prompts, clock.now() + patience, [](const reason::Progress&) {}, {.stop = stop});
  if (stop.stop_requested()) {  // what was said may be cut
    return Error{Error::Code::too_late, "the question was withdrawn"};
  }
  if (!replies.has_value() && replies.error().code != Error::Code::malformed) {
    return replies.error();
  }
  // Malformed: whatever was said, there is no answer in it.
  const std::vector<reason::Reply> said =
      replies.has_value() ? replies.value() : std::vector<reason::Reply>(prompts.size());
  Score one{.finding = eval::finding_of(record.at_trigger->time, *record.hindsight),
            .by_forecast = preview::best_by_forecast(preview.situation.facts),
            .with_facts = said_in(said[0], prompts[0], preview.situation),
            .without_facts = said_in(said[1], prompts[1], preview.situation)};
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

}  // namespace

PolicyId likeliest(const eval::Probabilities& probabilities) {
  return likeliest_policy(reason::Answer{.probability = probabilities});
}

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
  const InterruptStop interrupt;
  SteadyClock clock;
  ProgressLine progress("asking " + model.description(), options.survey.count, clock);
  const int before = static_cast<int>(scores.size());
  for (; scores.size() < count; ++number) {
    if (interrupted()) {
      return std::optional<std::vector<Score>>();
    }
    const auto one = score(source, number, model, clock, interrupt.token());
    if (!one.has_value()) {
      if (interrupted()) {
        return std::optional<std::vector<Score>>();
      }
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

}  // namespace saca::app
