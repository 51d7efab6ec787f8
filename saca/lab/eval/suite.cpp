#include "saca/lab/eval/suite.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/encounter/recorded_driver.h"

namespace saca::eval {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;
using nlohmann::json;

// --- one encounter

struct PlayResult {
  std::optional<Comparison> comparison;
  std::string fault;
};

PlayResult play(const scenario::Scenario& scenario, std::uint64_t number,
                const SuiteOptions& options, const runtime::PlanesSetup& saca,
                const intent::Model& intent) {
  const scenario::Scenario world = as_played(scenario, options);
  const encounter::Stage stage = stage_of(world, number, options, saca, intent);
  try {
    Hindsight hindsight(*saca.forecast.car, *saca.forecast.harm);
    const runtime::PlanesSetup shared = with_shared_verdicts(saca);
    std::vector<std::unique_ptr<encounter::Method>> methods;
    for (const std::string& name : options.methods) {
      methods.push_back(make_method(name, {.saca = shared,
                                           .hindsight = &hindsight,
                                           .intent = &intent,
                                           .danger = options.danger,
                                           .experience = options.experience,
                                           .imitators = options.imitators,
                                           .untuned = options.untuned,
                                           .seed = encounter_seed(options.seed, number)}));
    }
    auto compared = compare(stage, methods, hindsight);
    if (!compared.has_value()) {
      return {std::nullopt, compared.error().message};
    }
    return {std::move(compared).value(), ""};
  } catch (const std::exception& fault) {
    return {std::nullopt, fault.what()};
  }
}

std::optional<DriverRow> driver_of(const scenario::Scenario& scenario, const Comparison& comparison,
                                   const runtime::PlanesSetup& saca) {
  if (!comparison.woke) {
    return std::nullopt;
  }
  const auto driver = encounter::recorded_driver(scenario, *saca.forecast.car, *saca.forecast.harm,
                                                 *comparison.woke);
  if (!driver) {
    return std::nullopt;
  }
  DriverRow row{.harm = driver->outcome.harm,
                .met = {},
                .brakes = encounter::brakes(*driver),
                .steers = encounter::steers(*driver)};
  if (const auto& contact = driver->outcome.contact) {
    row.met = contact->actor ? actor_name(driver->met[*contact->actor]) : std::string("edge");
    row.impact_speed = contact->relative_speed;
  }
  return row;
}

// --- lines of a journal

template <class T>
json json_of(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

template <class T>
std::optional<T> optional_from(const json& in) {
  return in.is_null() ? std::nullopt : std::optional(in.get<T>());
}

json json_of(const Plan& plan) {
  json out = json::array({manoeuvre::index(plan.policy)});
  if (plan.target_speed || plan.strength) {
    out.push_back(json_of(plan.target_speed));
    out.push_back(json_of(plan.strength));
  }
  return out;
}

Plan plan_from(const json& in) {
  Plan plan{.policy = manoeuvre::policy_from(in.at(0).get<int>()).value(), .target_speed = {}};
  if (in.size() > 1) {
    plan.target_speed = optional_from<double>(in.at(1));
    plan.strength = optional_from<double>(in.at(2));
  }
  return plan;
}

json json_of(const encounter::ExpectedAtDecision& one) {
  return json::array({one.time, json_of(one.plan), one.harm, one.braking_harm, one.num_admissible});
}

encounter::ExpectedAtDecision expected_from(const json& in) {
  return {.time = in.at(0).get<double>(),
          .plan = plan_from(in.at(1)),
          .harm = in.at(2).get<double>(),
          .braking_harm = in.at(3).get<double>(),
          .num_admissible = in.at(4).get<int>()};
}

json json_of(const encounter::ThinkingFigures& one) {
  return json::array({one.forecasts, one.recalled, one.from_memory, one.from_model, one.asked,
                      one.answered, one.ended, one.statements, one.false_statements, one.unfounded,
                      json_of(one.answer), one.expected ? json_of(*one.expected) : json()});
}

encounter::ThinkingFigures thinking_from(const json& in) {
  const auto number = [&](std::size_t i) { return in.at(i).get<int>(); };
  return {.forecasts = number(0),
          .recalled = number(1),
          .from_memory = number(2),
          .from_model = number(3),
          .asked = number(4),
          .answered = number(5),
          .ended = number(6),
          .statements = number(7),
          .false_statements = number(8),
          .unfounded = number(9),
          .answer = optional_from<std::array<double, manoeuvre::num_policies>>(in.at(10)),
          .expected = in.at(11).is_null() ? std::nullopt : std::optional(expected_from(in.at(11)))};
}

json json_of(const Comparison& one) {
  json tried = json::array();
  for (const TriedPlan& plan : one.tried) {
    tried.push_back(json::array({json_of(plan.plan), json_of(plan.harm), plan.contact}));
  }
  json runs = json::array();
  for (const MethodRun& run : one.runs) {
    runs.push_back(json::array({json_of(run.acted_at), run.plan ? json_of(*run.plan) : json(),
                                run.source, run.reason, run.switches, run.harm, run.collision_loss,
                                json_of(run.met), run.impact_speed, run.clearance, run.fault,
                                run.thinking ? json_of(*run.thinking) : json()}));
  }
  return {{"trigger", json_of(one.trigger)},
          {"threat", json_of(one.threat)},
          {"woke", json_of(one.woke)},
          {"tried", std::move(tried)},
          {"best", one.best ? json_of(*one.best) : json()},
          {"best_harm", one.best_harm},
          {"published_best_harm", one.published_best_harm},
          {"runs", std::move(runs)}};
}

Comparison comparison_from(const json& in, std::size_t num_methods) {
  Comparison one;
  one.trigger = optional_from<double>(in.at("trigger"));
  one.woke = optional_from<double>(in.at("woke"));
  one.threat = optional_from<std::string>(in.at("threat"));
  for (const json& plan : in.at("tried")) {
    one.tried.push_back({.plan = plan_from(plan.at(0)),
                         .harm = optional_from<double>(plan.at(1)),
                         .contact = plan.at(2).get<bool>()});
  }
  if (!in.at("best").is_null()) {
    one.best = plan_from(in.at("best"));
  }
  one.best_harm = in.at("best_harm").get<double>();
  one.published_best_harm = in.at("published_best_harm").get<double>();
  for (const json& run : in.at("runs")) {
    MethodRun& back = one.runs.emplace_back();
    back.acted_at = optional_from<double>(run.at(0));
    if (!run.at(1).is_null()) {
      back.plan = plan_from(run.at(1));
    }
    back.source = run.at(2).get<std::string>();
    back.reason = run.at(3).get<std::string>();
    back.switches = run.at(4).get<int>();
    back.harm = run.at(5).get<double>();
    back.collision_loss = run.at(6).get<double>();
    back.met = optional_from<std::string>(run.at(7));
    back.impact_speed = run.at(8).get<double>();
    back.clearance = run.at(9).get<double>();
    back.fault = run.at(10).get<std::string>();
    if (!run.at(11).is_null()) {
      back.thinking = thinking_from(run.at(11));
    }
  }
  if (one.runs.size() != num_methods) {
    throw std::runtime_error(
        fmt::format("want runs of {} methods, got {}", num_methods, one.runs.size()));
  }
  return one;
}

json json_of(const DriverRow& driver) {
  return json::array(
      {driver.harm, json_of(driver.met), driver.impact_speed, driver.brakes, driver.steers});
}

DriverRow driver_from(const json& in) {
  return {.harm = in.at(0).get<double>(),
          .met = optional_from<std::string>(in.at(1)),
          .impact_speed = in.at(2).get<double>(),
          .brakes = in.at(3).get<bool>(),
          .steers = in.at(4).get<int>()};
}

}  // namespace

scenario::PerceptionModel usual_perception() {
  scenario::PerceptionModel model;
  model.position_sd = 0.2;
  model.velocity_sd = 0.2;
  model.heading_sd = 0.02;
  model.correlation_time = 0.5;
  model.latency = 0.1;
  model.dropout = 0.01;
  model.range = 150.0;
  model.occlusion = true;
  model.confirmation = 0.1;
  model.memory = 1.0;
  return model;
}

std::uint64_t encounter_seed(std::uint64_t seed, std::uint64_t number) {
  return scenario::generator(seed, number)();
}

scenario::Chance chance_of(const SuiteOptions& options, std::uint64_t number) {
  return options.exact ? scenario::Chance{}
                       : scenario::draw_chance(encounter_seed(options.seed, number), 0, 0.0);
}

scenario::Scenario as_played(scenario::Scenario scenario, const SuiteOptions& options) {
  scenario::PerceptionModel besides_grip = scenario.perception;
  besides_grip.grip_believed.reset();
  if (!options.exact && besides_grip == scenario::PerceptionModel{}) {
    const auto believed = scenario.perception.grip_believed;
    scenario.perception = usual_perception();
    scenario.perception.grip_believed = believed;
  }
  return scenario;
}

encounter::Stage stage_of(const scenario::Scenario& world, std::uint64_t number,
                          const SuiteOptions& options, const runtime::PlanesSetup& saca,
                          const intent::Model& intent) {
  return {.scenario = &world,
          .car = saca.forecast.car,
          .harm = saca.forecast.harm,
          .intent = &intent,
          .thresholds = saca.thresholds,
          .chance = chance_of(options, number)};
}

SuiteRow run_encounter(const SuiteEncounter& encounter, const SuiteOptions& options,
                       const runtime::PlanesSetup& saca, const intent::Model& intent) {
  expects(!options.methods.empty(), "at least one method");
  SuiteRow row{.number = encounter.number,
               .family = encounter.family,
               .fault = {},
               .risk = {},
               .twin = {},
               .driver = {}};
  PlayResult risk = play(encounter.scenario, encounter.number, options, saca, intent);
  row.fault = risk.fault;
  if (!risk.comparison) {
    return row;
  }
  row.risk = std::move(*risk.comparison);
  row.driver = driver_of(encounter.scenario, row.risk, saca);
  if (encounter.twin) {
    PlayResult twin = play(*encounter.twin, encounter.number, options, saca, intent);
    row.fault = twin.fault;
    row.twin = std::move(twin.comparison);
  }
  return row;
}

std::optional<TriedScene> tried_in(const SuiteEncounter& encounter, const SuiteOptions& options,
                                   const runtime::PlanesSetup& saca, const intent::Model& intent) {
  const scenario::Scenario world = as_played(encounter.scenario, options);
  const encounter::Stage stage = stage_of(world, encounter.number, options, saca, intent);
  encounter::ClosedLoop loop(stage);
  while (!loop.over()) {
    if (loop.look()) {
      return std::nullopt;
    }
    loop.wake();
    if (loop.driven() && loop.trigger()) {
      return TriedScene{loop.truth().whole_scene(),
                        try_all(loop, *stage.car, *stage.harm, Knowledge::everything)};
    }
    loop.keep();
    loop.advance();
  }
  return std::nullopt;
}

json to_json(const SuiteRow& row) {
  json out{{"number", row.number}, {"family", row.family}};
  if (!row.fault.empty()) {
    out["fault"] = row.fault;
  } else {
    out["risk"] = json_of(row.risk);
    if (row.twin) {
      out["twin"] = json_of(*row.twin);
    }
    if (row.driver) {
      out["driver"] = json_of(*row.driver);
    }
  }
  return out;
}

Result<SuiteRow> suite_row_from_json(const json& in, std::size_t num_methods) {
  try {
    SuiteRow row{.number = in.at("number").get<std::uint64_t>(),
                 .family = in.at("family").get<std::string>(),
                 .fault = in.value("fault", std::string()),
                 .risk = {},
                 .twin = {},
                 .driver = {}};
    if (row.fault.empty()) {
      row.risk = comparison_from(in.at("risk"), num_methods);
      if (in.contains("twin")) {
        row.twin = comparison_from(in.at("twin"), num_methods);
      }
      if (in.contains("driver")) {
        row.driver = driver_from(in.at("driver"));
      }
    }
    return row;
  } catch (const std::exception& problem) {
    return Error{Error::Code::malformed, one_line(problem.what())};
  }
}

std::string line_of(const SuiteRow& row) {
  return to_json(row).dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<SuiteRow> suite_row_from(std::string_view line, std::size_t num_methods) {
  const auto read = formats::parse_json(line);
  if (!read.has_value()) {
    return Error{Error::Code::malformed, "want one encounter of a suite: " + read.error().message};
  }
  auto row = suite_row_from_json(read.value(), num_methods);
  if (!row.has_value()) {
    return Error{Error::Code::malformed,
                 fmt::format("want one encounter of a suite, got \"{}\": {}", one_line(line, 80),
                             row.error().message)};
  }
  return row;
}

bool counts_in_figures(const SuiteRow& row) {
  const auto threw = [](const MethodRun& run) { return !run.fault.empty(); };
  const auto nobody_threw = [&](const Comparison& one) {
    return std::none_of(one.runs.begin(), one.runs.end(), threw);
  };
  return row.fault.empty() && nobody_threw(row.risk) && (!row.twin || nobody_threw(*row.twin));
}

std::optional<std::string> failure_of(const SuiteRow& row,
                                      const std::vector<std::string>& methods) {
  if (!row.fault.empty()) {
    return "could not be played: " + row.fault;
  }
  const auto thrown = [&](const Comparison& one, const char* where) -> std::optional<std::string> {
    for (std::size_t m = 0; m < one.runs.size(); ++m) {
      if (!one.runs[m].fault.empty()) {
        return fmt::format("{} failed{}: {}", methods.at(m), where, one.runs[m].fault);
      }
    }
    return std::nullopt;
  };
  const auto in_risk = thrown(row.risk, "");
  return in_risk || !row.twin ? in_risk : thrown(*row.twin, " in its twin");
}

bool agrees(const DriverRow& driver, const std::optional<manoeuvre::Plan>& plan) {
  const PolicyId policy = plan ? plan->policy : PolicyId::no_intervention;
  const bool plan_brakes =
      policy == PolicyId::aeb || manoeuvre::brakes_to_speed(policy) || manoeuvre::drifts(policy);
  return plan_brakes == driver.brakes && manoeuvre::side(policy) == driver.steers;
}

}  // namespace saca::eval
