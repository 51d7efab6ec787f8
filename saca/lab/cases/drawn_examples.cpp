#include "saca/lab/cases/drawn_examples.h"

#include <limits>
#include <utility>

#include "saca/lab/cases/case_stage.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/language_model/reply_grammar.h"

namespace saca::cases {

namespace {

/// What every policy is expected to harm, cues standing for what this law says.
memory::PolicyHarms expected_by(const intent::CueLaw& law, const AtFirstTrigger& now,
                                preview::ForecastTools tools) {
  tools.cues = &law;
  const reflex::Verdict verdict = arbitration::Forecaster(tools).judge(now.seen, now.beliefs);
  memory::PolicyHarms harms;
  for (const reflex::JudgedPlan& one : verdict.plans) {
    auto& harm = harms.at(manoeuvre::index(one.plan.policy));
    if (one.drivable && one.harm < harm.value_or(std::numeric_limits<double>::infinity())) {
      harm = one.harm;
    }
  }
  return harms;
}

/// Adds the example of one encounter, where its trigger fires.
/// @param words  seed of the reply's
/// @param seed   of the encounter
void add_example(DrawnExamples& all, const scenario::Scenario& drawn, ReplyExample example,
                 const ExampleSource& source, std::uint64_t words, std::uint64_t seed) {
  const scenario::Scenario world = case_world(drawn, seed);
  const preview::ForecastTools& tools = source.tools.forecast;
  auto played = at_first_trigger(
      case_stage(world, source.tools, seed, example.record + (example.is_twin ? "_twin" : "")),
      tools);
  if (!played.has_value()) {
    all.problem = example.record + ": " + played.error().message;
    return;
  }
  if (!played.value()) {
    return;
  }
  AtFirstTrigger now = *std::move(played).value();
  if (source.cues) {
    example.known = expected_by(source.cues->law, now, tools);
    example.by_table = expected_by(*tools.cues, now, tools);
  }
  const auto told = source.told ? source.told->in(now.situation.scene_at_trigger) : std::nullopt;
  auto made = reply_example(std::move(example), now.situation, told, words);
  if (made) {
    all.examples.push_back({.example = *std::move(made),
                            .situation = std::move(now.situation),
                            .nearest = told ? std::optional(told->found) : std::nullopt});
  }
}

}  // namespace

std::string DrawnExample::grammar(const std::optional<manoeuvre::PolicyId>& choice) const {
  return language_model::reply_grammar(situation, example.prompt, nearest, choice);
}

DrawnExamples drawn_examples(const CrashCase& one, const ExampleSource& source,
                             std::uint64_t words) {
  DrawnExamples all;
  const auto again = drawn_again(one, source.tools.car_name,
                                 manoeuvre::footprint(*source.tools.forecast.car), source.cues);
  if (!again.has_value()) {
    all.problem = again.error().message;
    return all;
  }
  ReplyExample example{.record = one.record.name, .family = one.family};
  for (std::size_t k = 0; k < one.judged.happened.size(); ++k) {
    if (one.judged.happened.at(k)) {
      example.known.at(k) = one.judged.happened.at(k)->harm.value;
    }
  }
  add_example(all, again.value().scenario, example, source, words, one.seed);
  example.known = {};
  example.is_twin = true;
  add_example(all, again.value().twin, std::move(example), source, words, one.seed);
  return all;
}

}  // namespace saca::cases
