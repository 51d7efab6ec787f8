#include "saca/lab/eval/paper_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "saca/lab/eval/whatif.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::eval {
namespace {

constexpr std::array<PublishedRow, 3> intersection_rows{
    {{"Imitation learning", 2.36, 0.35},
     {"Language model without fine-tuning", 1.85, 0.27},
     {"SACA with a fine-tuned model", 0.54, 0.05}}};
constexpr std::array<PublishedRow, 4> one_way_rows{
    {{"Imitation learning", 0.49, 0.50},
     {"Language model without fine-tuning", 1.06, 0.20},
     {"Language model without scenario awareness", 0.65, 0.0},
     {"SACA with a fine-tuned model", 0.07, 0.0}}};

constexpr std::array<PaperTable, 3> all_tables{
    {{"table_2", "Table II: intersection",
      "Ego at 10, 11, ... 15 m/s where the paper has it at 14; the truck drives on, or brakes hard "
      "(no risk)",
      "intersection_t1", "intersection_t1_truck_brakes", "ego.speed_mps=10:15:1",
      intersection_rows},
     {"table_2_late",
      "Table II with a late truck (ours): at 14 m/s whoever brakes at T1 is struck",
      "The same 1.87 s later, a queue barring the way ahead: the story of Fig. 9, which the "
      "printed distances do not give; without risk the truck brakes and nobody queues",
      "intersection_late_truck",
      "intersection_late_truck_brakes",
      "ego.speed_mps=10:15:1",
      {}},
     {"table_3", "Table III: one-way road",
      "Ego at 12 m/s; without risk the obstacle ahead is not there", "one_way", "one_way_free", "",
      one_way_rows}}};

constexpr std::array<PublishedReplies, 2> all_replies{
    {{"table_2", 371.0, 5.7, 3.7}, {"table_3", 352.0, 5.3, 3.5}}};

Result<scenario::Scenario> shipped(const std::filesystem::path& scenarios, std::string_view name,
                                   const manoeuvre::Car& car) {
  return scenario::load_scenario(scenarios / fmt::format("{}.toml", name),
                                 manoeuvre::footprint(car));
}

/// The scene at each of several speeds of the ego, everything else at `at` where it is.
Result<std::vector<scenario::Scenario>> at_speeds(const scenario::Scenario& scenario,
                                                  const manoeuvre::Car& car, double at,
                                                  const Axis& axis) {
  std::vector<scenario::Scenario> all;
  for (const double speed : axis.values) {
    auto one = varied(scenario, car, at, axis, speed);
    if (!one.has_value()) {
      return one.error();
    }
    all.push_back(std::move(one).value());
  }
  return all;
}

}  // namespace

std::span<const PaperTable> paper_tables() {
  return all_tables;
}

const PaperTable* find_paper_table(std::string_view name) {
  const auto* const found = std::find_if(all_tables.begin(), all_tables.end(),
                                         [&](const PaperTable& one) { return one.name == name; });
  return found == all_tables.end() ? nullptr : found;
}

std::span<const PublishedReplies> published_replies() {
  return all_replies;
}

Result<std::vector<SuiteEncounter>> encounters_of(const PaperTable& table,
                                                  const std::filesystem::path& scenarios,
                                                  const manoeuvre::Car& car) {
  const auto risk = shipped(scenarios, table.risk, car);
  if (!risk.has_value()) {
    return risk.error();
  }
  const auto free = shipped(scenarios, table.free, car);
  if (!free.has_value()) {
    return free.error();
  }
  if (table.speeds.empty()) {
    return std::vector<SuiteEncounter>{{.number = 0,
                                        .family = std::string(table.risk),
                                        .scenario = risk.value(),
                                        .twin = free.value()}};
  }
  const auto axis = parse_axis(table.speeds, risk.value());
  if (!axis.has_value()) {
    return axis.error();
  }
  const auto at = trigger_time(risk.value(), car);
  if (!at) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want a scene that triggers", table.risk)};
  }
  const auto with_risk = at_speeds(risk.value(), car, *at, axis.value());
  if (!with_risk.has_value()) {
    return with_risk.error();
  }
  const auto without = at_speeds(free.value(), car, *at, axis.value());
  if (!without.has_value()) {
    return without.error();
  }
  std::vector<SuiteEncounter> all;
  for (std::size_t i = 0; i < axis.value().values.size(); ++i) {
    all.push_back({.number = i,
                   .family = fmt::format("{:g} m/s", axis.value().values[i]),
                   .scenario = with_risk.value()[i],
                   .twin = without.value()[i]});
  }
  return all;
}

}  // namespace saca::eval
