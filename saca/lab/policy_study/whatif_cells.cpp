#include "saca/lab/policy_study/whatif_cells.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::policy_study {
namespace {

using eval::Axis;
using eval::Cell;

/// The scenario at one place of the map, or why there is none.
Result<scenario::Scenario> scenario_at(const WhatifMap& map, std::size_t cell) {
  auto changed = Result<scenario::Scenario>(*map.scenario);
  for (const Axis& axis : map.axes) {
    const double value = axis.values[cell % axis.values.size()];
    cell /= axis.values.size();
    changed = eval::varied(changed.value(), *map.car, map.time, axis, value);
    if (!changed.has_value()) {
      return changed;
    }
  }
  return changed;
}

std::size_t num_cells(const std::vector<Axis>& axes) {
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    count *= axis.values.size();
  }
  return count;
}

using Problems = std::vector<std::optional<Error>>;  ///< why a cell cannot be, one for each

/// Why no cell can be; nullopt: one can.
std::optional<Error> why_none(const std::vector<Cell>& cells, const Problems& problems) {
  if (std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.possible; })) {
    return std::nullopt;
  }
  const auto why = std::find_if(problems.begin(), problems.end(),
                                [](const auto& problem) { return problem.has_value(); });
  return why == problems.end()
             ? Error{Error::Code::out_of_range, "--vary: bodies overlap whatever the value"}
             : **why;
}

}  // namespace

Result<std::vector<Axis>> axes_of(const std::vector<std::string>& texts,
                                  const scenario::Scenario& scenario) {
  std::vector<Axis> axes;
  for (const std::string& text : texts) {
    const auto axis = eval::parse_axis(text, scenario);
    if (!axis.has_value()) {
      return Error{axis.error().code, "--vary " + axis.error().message};
    }
    axes.push_back(axis.value());
  }
  if (axes.size() == 2 && axes[0].what == axes[1].what) {
    return Error{Error::Code::malformed,
                 "--vary: want two different numbers, got " + axes[0].what + " twice"};
  }
  if (num_cells(axes) > most_cells) {
    return Error{Error::Code::out_of_range, fmt::format("--vary: want at most {} scenes, got {}",
                                                        most_cells, num_cells(axes))};
  }
  return axes;
}

Result<std::optional<std::vector<Cell>>> try_cells(const WhatifMap& map,
                                                   const collision::HarmModel& harm,
                                                   const CellsWork& work) {
  std::vector<Cell> cells(num_cells(map.axes));
  Problems problems(cells.size());
  SteadyClock clock;
  long_work::ProgressLine progress("what if", static_cast<int>(cells.size()), clock, work.display);
  long_work::watch_for_interrupt();
  constexpr std::size_t at_once = 32;
  for (std::size_t from = 0; from < cells.size(); from += at_once) {
    if (long_work::interrupted()) {
      return std::optional<std::vector<Cell>>();
    }
    const std::size_t to = std::min(cells.size(), from + at_once);
    std::vector<std::optional<scenario::Scenario>> varied(to - from);
    in_parallel(to - from, work.threads, [&](std::size_t i) {
      const auto scenario = scenario_at(map, from + i);
      if (scenario.has_value()) {
        varied[i] = scenario.value();
      } else {
        problems[from + i] = scenario.error();
      }
    });
    const auto tried = eval::try_cells(varied, *map.car, harm, map.time, work.threads);
    std::copy(tried.begin(), tried.end(), cells.begin() + static_cast<std::ptrdiff_t>(from));
    if (to < cells.size()) {
      progress.show(static_cast<int>(to), 0, " scenes");
    }
  }
  if (auto problem = why_none(cells, problems)) {
    return *std::move(problem);
  }
  return std::optional(std::move(cells));
}

}  // namespace saca::policy_study
