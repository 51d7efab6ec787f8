#include "apps/saca/cases_examples.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

#include "apps/saca/cases_making.h"
#include "saca/base/core/fnv.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/families/splits.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {

using eval::CrashCase;
using eval::ReplyExample;

void add_example_options(CLI::App& command, ExampleOptions& options) {
  command.add_option("FILE", options.file, "What `build` wrote")->required();
  command.add_option("--memory", options.memory,
                     "A bank whose most alike case prompts tell of; without, they tell of none");
  command.add_option("--car", options.car, "That the cases were made with")->capture_default_str();
  command.add_option("--cues", options.cues,
                     "Other encounters of the same cases, with the cues of this suite");
  command.add_option("--seed", options.seed, "Of the replies' words: same seed, same bytes")
      ->capture_default_str();
}

std::string example_text(const ExampleOptions& options) {
  return fmt::format("--car {} --seed {}{}{}", options.car, options.seed,
                     options.memory.empty() ? "" : " --memory " + options.memory,
                     options.cues.empty() ? "" : " --cues " + options.cues);
}

ToldCases::ToldCases(std::vector<memory::Case> cases)
    : cases_(std::move(cases)), experience_(cases_) {
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    place_of_[cases_[i].id] = i;
  }
}

std::optional<eval::ToldCase> ToldCases::in(const world::Scene& scene) const {
  const auto recalled = experience_.recall(match::features(scene));
  if (!recalled) {
    return std::nullopt;
  }
  return eval::ToldCase{cases_[place_of_.at(recalled->nearest)], recalled->similarity};
}

Result<ExampleSource> open_examples(const ExampleOptions& options) {
  ExampleSource all;
  const auto text = formats::read_compressed(options.file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  auto cases = eval::crash_cases_from_text(text.value(), options.file);
  if (!cases.has_value()) {
    return cases.error();
  }
  auto planes = open_planes(options.car);
  if (!planes.has_value()) {
    return planes.error();
  }
  all.planes = std::move(planes).value();
  const std::filesystem::path scenarios = all.planes->inputs.places.root / "scenarios";
  if (!options.cues.empty()) {
    auto cues = eval::cues_of_suite(scenarios / "families", options.cues);
    if (!cues.has_value()) {
      return Error{cues.error().code, "--cues: " + cues.error().message};
    }
    all.cues = std::move(cues).value();
  }
  const auto splits = families::load_splits(scenarios / "splits.toml");
  if (!splits.has_value()) {
    return splits.error();
  }
  Fnv hash;
  hash.add(text.value());
  for (CrashCase& one : std::move(cases).value()) {
    const auto& test_only = splits.value().test_only;
    if (!one.kind) {
      ++all.recorded;
    } else if (std::find(test_only.begin(), test_only.end(), *one.kind) != test_only.end()) {
      ++all.test_only;
    } else {
      all.cases.push_back(std::move(one));
    }
  }
  if (all.cases.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases that were drawn from families of the tuning split, "
                             "got {} recorded ones and {} of families for tests",
                             options.file, all.recorded, all.test_only)};
  }
  if (!options.memory.empty()) {
    auto bank = memory::Store::open_existing(options.memory);
    auto stored = bank.has_value() ? std::move(bank).value().all()
                                   : Result<std::vector<memory::Case>>(bank.error());
    if (!stored.has_value()) {
      return stored.error();
    }
    hash.add(memory::cases_text(stored.value()));
    all.told.emplace(std::move(stored).value());
  }
  hash.add(options.cues);
  if (all.cues) {
    hash.add(intent::digest(all.cues->law));
    hash.add(intent::digest(all.planes->inputs.cues));
  }
  all.digest = hash.value();
  return all;
}

namespace {

/// What every policy is expected to harm, cues standing for what this law says.
memory::PolicyHarms expected_by(const intent::CueLaw& law, const eval::AtFirstTrigger& now,
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
void add_example(DrawnExamples& all, const scenario::Scenario& drawn, ReplyExample example,
                 const ExampleSource& source, const ExampleOptions& options, std::uint64_t seed) {
  const Inputs& inputs = source.planes->inputs;
  const scenario::Scenario world = case_world(drawn, seed);
  const preview::ForecastTools& tools = source.planes->setup.forecast;
  auto played = eval::at_first_trigger(
      case_stage(world, inputs, seed, example.record + (example.is_twin ? "_twin" : "")), tools);
  if (!played.has_value()) {
    all.problem = example.record + ": " + played.error().message;
    return;
  }
  if (!played.value()) {
    return;
  }
  eval::AtFirstTrigger now = *std::move(played).value();
  if (source.cues) {
    example.known = expected_by(source.cues->law, now, tools);
    example.by_table = expected_by(inputs.cues, now, tools);
  }
  const auto told = source.told ? source.told->in(now.situation.scene_at_trigger) : std::nullopt;
  auto made = eval::reply_example(std::move(example), now.situation, told, options.seed);
  if (made) {
    all.examples.push_back({*std::move(made), std::move(now.situation)});
  }
}

}  // namespace

DrawnExamples drawn_examples(const CrashCase& one, const ExampleSource& source,
                             const ExampleOptions& options) {
  DrawnExamples all;
  const Inputs& inputs = source.planes->inputs;
  const auto again =
      eval::drawn_again(one, inputs.car_name, manoeuvre::footprint(inputs.car), source.cues);
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
  add_example(all, again.value().scenario, example, source, options, one.seed);
  example.known = {};
  example.is_twin = true;
  add_example(all, again.value().twin, std::move(example), source, options, one.seed);
  return all;
}

}  // namespace saca::app
