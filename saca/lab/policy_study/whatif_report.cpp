#include "saca/lab/policy_study/whatif_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace saca::policy_study {
namespace {

using nlohmann::json;

json cell_json(const eval::Cell& cell) {
  json harms = json::array();
  for (const auto& harm : cell.harms) {
    harms.push_back(harm ? json(*harm) : json());
  }
  return cell.possible ? json{{"best", manoeuvre::index(cell.best)},
                              {"alone", cell.alone},
                              {"margin", cell.margin},
                              {"contact", cell.contact},
                              {"harm", harms}}
                       : json();
}

/// A line for each policy that is best somewhere.
std::string shares_text(const std::vector<eval::Cell>& cells) {
  std::array<int, manoeuvre::num_policies> counts{};
  for (const eval::Cell& cell : cells) {
    counts[manoeuvre::index(cell.best)] += cell.possible ? 1 : 0;
  }
  std::string text;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    if (counts[manoeuvre::index(policy)] > 0) {
      text +=
          fmt::format("  {:6} best in {:5.1f} %\n", name(policy),
                      100.0 * counts[manoeuvre::index(policy)] / static_cast<double>(cells.size()));
    }
  }
  return text;
}

}  // namespace

std::string text_of(const WhatifMap& map) {
  const std::vector<eval::Cell>& cells = map.cells;
  std::string text =
      fmt::format("{}, {} scenes, from {:.2f} s on\n", map.scenario->title, cells.size(), map.time);
  text += shares_text(cells);
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const auto refused = std::count_if(cells.begin(), cells.end(), [&](const eval::Cell& cell) {
      return cell.possible && !cell.harms.at(manoeuvre::index(policy));
    });
    if (refused > 0) {
      text +=
          fmt::format("  {:6} cannot be driven in {} of {}\n", name(policy), refused, cells.size());
    }
  }
  const auto impossible = std::count_if(cells.begin(), cells.end(),
                                        [](const eval::Cell& cell) { return !cell.possible; });
  if (impossible > 0) {
    text += fmt::format("  {} of {} cannot be: bodies would overlap, or a value is out of range\n",
                        impossible, cells.size());
  }
  return text;
}

json json_of(const WhatifMap& map) {
  json all{{"schema", "saca.whatif/1"},
           {"scenario", map.scenario->name},
           {"time_s", map.time},
           {"axes", json::array()},
           {"cells", json::array()}};
  for (const eval::Axis& axis : map.axes) {
    all["axes"].push_back({{"what", axis.what}, {"values", axis.values}});
  }
  for (const eval::Cell& cell : map.cells) {
    all["cells"].push_back(cell_json(cell));
  }
  return all;
}

}  // namespace saca::policy_study
