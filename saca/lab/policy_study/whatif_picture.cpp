#include "saca/lab/policy_study/whatif_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "saca/lab/report/map_svg.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::policy_study {
namespace {

std::array<bool, manoeuvre::num_policies> refused_in(const eval::Cell& cell) {
  std::array<bool, manoeuvre::num_policies> refused{};
  for (std::size_t i = 0; i < refused.size(); ++i) {
    refused.at(i) = !cell.harms.at(i).has_value();
  }
  return refused;
}

report::MapCell drawn(const eval::Cell& cell) {
  if (!cell.possible) {
    return {.verdict = report::MapVerdict::unplayable};
  }
  const bool no_risk = *cell.harms[manoeuvre::index(manoeuvre::PolicyId::no_intervention)] <
                       0.5 * collision::harm_tie;
  return {.verdict = no_risk ? report::MapVerdict::no_risk : report::MapVerdict::decided,
          .best = cell.best,
          .margin = cell.margin,
          .refused = refused_in(cell)};
}

report::MapAxis drawn(const eval::Axis& axis, const std::optional<double>& nominal) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> units{{{"_m", "m"},
                                                                                {"_mps", "m/s"},
                                                                                {"_mps2", "m/s2"},
                                                                                {"_s", "s"},
                                                                                {"_deg", "deg"},
                                                                                {"_degps", "deg/s"},
                                                                                {"_kg", "kg"},
                                                                                {"_1pm", "1/m"},
                                                                                {"", "-"}}};
  const auto unit = std::find_if(units.begin(), units.end(),
                                 [&](const auto& one) { return axis.key.ends_with(one.first); });
  std::string name = axis.what;
  if (const auto at = name.rfind(axis.key);
      at != std::string::npos) {  // a place in a list may follow
    name.erase(at + axis.key.size() - unit->first.size(), unit->first.size());
  }
  return {
      .name = name, .unit = std::string(unit->second), .values = axis.values, .nominal = nominal};
}

std::vector<report::HarmCurve> curves_of(const std::vector<eval::Cell>& cells) {
  std::vector<report::HarmCurve> curves;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    report::HarmCurve curve{.policy = policy, .harm = {}, .low = {}, .high = {}};
    for (const eval::Cell& cell : cells) {
      curve.harm.push_back(cell.harms[manoeuvre::index(policy)]);
    }
    curves.push_back(curve);
  }
  return curves;
}

}  // namespace

std::string whatif_svg(const WhatifMap& map) {
  std::vector<report::MapCell> drawn_cells;
  drawn_cells.reserve(map.cells.size());
  for (const eval::Cell& cell : map.cells) {
    drawn_cells.push_back(drawn(cell));
  }
  const std::vector<std::string> lines{
      map.scenario->title,
      fmt::format("All eight begin at {:.2f} s; everything else is where it was.", map.time)};
  const auto axis = [&](std::size_t i) {
    return drawn(map.axes[i], eval::nominal(*map.scenario, *map.car, map.time, map.axes[i]));
  };
  if (map.axes.size() == 2) {
    return report::map_svg({.title = "Which policy is best",
                            .lines = lines,
                            .x = axis(0),
                            .y = axis(1),
                            .cells = drawn_cells});
  }
  return report::strip_svg({.title = "Which policy is best",
                            .lines = lines,
                            .x = axis(0),
                            .cells = drawn_cells,
                            .curves = curves_of(map.cells)});
}

}  // namespace saca::policy_study
