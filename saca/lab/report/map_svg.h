#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::report {

/// A parameter that was varied.
struct MapAxis {
  std::string name;
  std::string unit;
  std::vector<double> values;     ///< increasing, at least one
  std::optional<double> nominal;  ///< where the scenario as it is lies; drawn where that is inside
};

/// What is to be said of one combination of parameters.
enum class MapVerdict : std::uint8_t {
  decided,     ///< a policy is best
  no_risk,     ///< without intervention nobody is touched
  unplayable,  ///< no such scene: bodies overlap at its start, a value is refused
};

struct MapCell {
  MapVerdict verdict = MapVerdict::decided;
  manoeuvre::PolicyId best = manoeuvre::PolicyId::aeb;  ///< of `decided`
  double margin = 0.0;  ///< harm of the second best minus that of the best [-], >= 0
  std::array<bool, manoeuvre::num_policies> refused{};  ///< cannot be driven from where the car is
};

/// Margins below which a colour is paler: a step each.
constexpr double margin_steps[] = {0.001, 0.01, 0.1};

/// Which policy is best over two parameters.
struct PolicyMap {
  std::string title;
  std::vector<std::string> lines;  ///< below the title
  MapAxis x;
  MapAxis y;
  std::vector<MapCell> cells;  ///< (y.values x x.values), row-major
};

/// Areas in the policies' colours with their names, paler where the margin is small; red lines
/// over cells in which a policy is refused; axes, the scenario as it is, and a legend with counts.
///
/// A cell reaches half-way to its neighbours.
/// @throws ContractViolation  unless there is one cell for each combination, values increase, and
///                            margins are >= 0
[[nodiscard]] std::string map_svg(const PolicyMap& map);

/// Expected harm of one policy over one parameter.
struct HarmCurve {
  manoeuvre::PolicyId policy = manoeuvre::PolicyId::aeb;
  std::vector<std::optional<double>> harm;  ///< nullopt where refused   (one per value)
  std::vector<double> low;                  ///< 95 % interval, or empty   (one per value)
  std::vector<double> high;
};

/// Which policy is best over one parameter, and what all would cost.
struct PolicyStrip {
  std::string title;
  std::vector<std::string> lines;
  MapAxis x;
  std::vector<MapCell> cells;  ///< one per value
  std::vector<HarmCurve> curves;
};

/// Where a policy is refused its curve breaks, and a red bar in a row of its own says so.
/// @throws ContractViolation  as map_svg, and unless each curve has one number per value
[[nodiscard]] std::string strip_svg(const PolicyStrip& strip);

}  // namespace saca::report
