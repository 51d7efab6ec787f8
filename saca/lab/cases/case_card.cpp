#include "saca/lab/cases/case_card.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "saca/lab/crash_records/record_family.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/policy_study/policy_sheet.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/preview/expected_harm.h"

namespace saca::cases {
namespace {

using manoeuvre::PolicyId;

/// The instant from which the pictures go on.
struct ShownMoment {
  std::unique_ptr<scenario::Scenario> scenario;  ///< that the moment refers to; of a recording none
  eval::DecisionPoint point;
};

/// Of an encounter that was drawn the truth, of a recording what was perceived, all going on.
Result<ShownMoment> shown_moment(const CrashCase& one, const CaseTools& tools) {
  if (!one.kind) {
    ShownMoment shown;
    const world::Scene& scene = one.judged.one.scene;
    shown.point = {
        .scene = scene,
        .others = [tracks = preview::all_going_on(scene).tracks](const auto&...) { return tracks; },
        .grip = one.grip};
    return shown;
  }
  const manoeuvre::Car& car = *tools.forecast.car;
  auto again = drawn_again(one, tools.car_name, manoeuvre::footprint(car));
  if (!again.has_value()) {
    return again.error();
  }
  ShownMoment shown{
      .scenario = std::make_unique<scenario::Scenario>(std::move(again).value().scenario),
      .point = {}};
  const auto time = eval::trigger_time(*shown.scenario, car);
  if (!time) {
    return Error{Error::Code::out_of_range,
                 one.record.name +
                     ": want an encounter in which the trigger fires; is the car "
                     "another one than it was drawn for?"};
  }
  shown.point = eval::decision_point_at(*shown.scenario, car, *time);
  return shown;
}

/// The plan among those that were tried, else the first of its policy.
const encounter::Hindsight& tried_plan(const std::vector<encounter::Hindsight>& tried,
                                       const manoeuvre::Plan& plan) {
  const auto same = std::find_if(tried.begin(), tried.end(), [&](const encounter::Hindsight& one) {
    return one.facts.plan == plan;
  });
  return same != tried.end()
             ? *same
             : *std::find_if(tried.begin(), tried.end(), [&](const encounter::Hindsight& one) {
                 return one.facts.plan.policy == plan.policy;
               });
}

std::string harm_text(const std::optional<double>& harm) {
  return harm ? fmt::format("{:.4f}", *harm) : std::string("-");
}

/// Policies by columns: expected, in truth, and whether a plan of it is admissible.
report::PageTable harms_table(const CrashCase& one) {
  report::PageTable table;
  table.lines = {fmt::format(
      "Harm of the best plan of each policy: expected by the verdict at the trigger, and over {} "
      "draws of what is left to chance. {} of {} plans are admissible (at most {}); the arbiter "
      "by itself begins {}.",
      one.judged.one.draws,
      std::count_if(one.judged.plans.begin(), one.judged.plans.end(),
                    [](const eval::VerdictPlan& plan) { return plan.admissible; }),
      one.judged.plans.size(), harm_text(one.judged.admissible_harm),
      plan_text(one.judged.speaks_for))};
  report::PageTable::Row expected{.name = "expected"};
  report::PageTable::Row happened{.name = "over draws"};
  report::PageTable::Row interval{.name = "95 % interval"};
  report::PageTable::Row contact{.name = "contact"};
  report::PageTable::Row admissible{.name = "admissible plans"};
  for (const PolicyId policy : manoeuvre::all_policies) {
    const std::size_t place = manoeuvre::index(policy);
    table.columns.emplace_back(name(policy));
    const auto& told = one.judged.one.told;
    expected.cells.push_back(harm_text(told ? told->at(place) : std::nullopt));
    const auto& over_draws = one.judged.happened.at(place);
    happened.cells.push_back(over_draws ? harm_text(over_draws->harm.value) : "-");
    interval.cells.push_back(over_draws ? fmt::format("{:.3f} to {:.3f}",
                                                      std::max(0.0, over_draws->harm.low),
                                                      over_draws->harm.high)
                                        : "-");
    contact.cells.push_back(over_draws ? fmt::format("{:.0f} %", 100.0 * over_draws->contact)
                                       : "-");
    const auto plans = std::count_if(one.judged.plans.begin(), one.judged.plans.end(),
                                     [&](const eval::VerdictPlan& plan) {
                                       return plan.admissible && plan.plan.policy == policy;
                                     });
    admissible.cells.push_back(fmt::format("{}", plans));
  }
  table.rows = {std::move(expected), std::move(happened), std::move(interval), std::move(contact),
                std::move(admissible)};
  return table;
}

report::PageTable facts_table(const CrashCase& one) {
  report::PageTable table{.heading = "What is recorded", .columns = {"of", "code", "in words"}};
  table.rows.reserve(one.facts.size());
  for (const crash_records::Fact& fact : one.facts) {
    table.rows.push_back(
        {.name = fact.key,
         .cells = {fact.about, fact.code ? fmt::format("{}", *fact.code) : "-", fact.words}});
  }
  return table;
}

report::PageTable assumptions_table(const CrashCase& one) {
  const auto recorded =
      std::count_if(one.ranges.begin(), one.ranges.end(), [](const RecordRange& range) {
        return range.source.starts_with(crash_records::recorded_prefix);
      });
  report::PageTable table{
      .heading = fmt::format("What the encounter was drawn from: {} of {} numbers are recorded",
                             recorded, one.ranges.size()),
      .columns = {"from", "to", "source"}};
  table.rows.reserve(one.ranges.size());
  for (const RecordRange& range : one.ranges) {
    table.rows.push_back({.name = range.key,
                          .cells = {fmt::format("{:.3g}", range.min),
                                    fmt::format("{:.3g}", range.max), range.source}});
  }
  return table;
}

/// Does the side that is hit agree with the record?
std::string_view agreement(const CrashCase& one) {
  if (!one.kind) {
    return "";
  }
  return !one.impact_agrees   ? " (which side was hit is not recorded)"
         : *one.impact_agrees ? " (as recorded)"
                              : " (another side than recorded)";
}

std::string without_text(const CrashCase& one) {
  if (!one.without) {
    return "Without avoidance nobody is met.";
  }
  const eval::WithoutAvoidance& without = *one.without;
  return fmt::format(
      "Without avoidance {} is met {:.1f} s after the trigger at {:.1f} m/s relative speed, with "
      "the ego's {}{}.",
      without.met, without.after, without.relative_speed, name(without.ego_face), agreement(one));
}

std::string title_of(const CrashCase& one) {
  std::string text = one.record.study;
  if (one.record.state && one.record.year) {
    text += fmt::format(" {} {}", *one.record.state, *one.record.year);
  }
  return fmt::format("{}, {} {}: {}{}", text, one.kind ? "ST_CASE" : "event", one.record.number,
                     one.family, one.place && *one.place != one.family ? ", " + *one.place : "");
}

}  // namespace

Result<report::GalleryCard> case_card(const CrashCase& one, const CaseTools& tools) {
  const auto shown = shown_moment(one, tools);
  if (!shown.has_value()) {
    return shown.error();
  }
  const eval::DecisionPoint& point = shown.value().point;
  const auto tried = std::move(
      encounter::all_plans_tried({&point, 1}, *tools.forecast.car, *tools.forecast.harm).front());
  report::GalleryCard card{.title = title_of(one), .lines = {without_text(one)}};
  card.lines.push_back(fmt::format("{:.1f} m/s, grip {:.2f}; best over the draws: {}.",
                                   norm(point.scene.ego.v_B), one.grip,
                                   plan_text(one.judged.one.plan)));
  card.done = policy_study::view_of(point.scene, tried_plan(tried, manoeuvre::doing_nothing));
  card.done.title = one.kind ? "Without avoidance" : "Without avoidance, all going on";
  if (!one.kind) {
    card.lines.emplace_back(
        "The pictures show the scene as it was perceived at the trigger, all others going on as "
        "they did then: how they really moved is in the recording, not in the case.");
  }
  card.best = policy_study::view_of(point.scene, tried_plan(tried, one.judged.one.plan));
  card.best.title = "Best: " + plan_text(one.judged.one.plan);
  card.tables = {harms_table(one)};
  card.folded = {facts_table(one)};
  if (!one.ranges.empty()) {
    card.folded.push_back(assumptions_table(one));
  }
  return card;
}

}  // namespace saca::cases
