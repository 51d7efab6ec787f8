#include "saca/lab/levelset/solve.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/levelset/own_systems.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::levelset {
namespace {

template <class Real>
Flow<Real> flow_for(const Problem& problem, const danger::Grid& grid, Differences differences) {
  if constexpr (std::is_same_v<Real, float>) {
    return problem.in_floats(grid, differences);
  } else {
    return problem.in_doubles(grid, differences);
  }
}

Settings settings_of(const Problem& problem, const Scheme& scheme) {
  return {
      .tube = problem.tube, .steps = scheme.steps, .cfl = scheme.cfl, .threads = scheme.threads};
}

/// Every other point; nullopt where that leaves too few.
std::optional<danger::Grid> coarser(const danger::Grid& grid) {
  danger::Grid coarse = grid;
  for (danger::Axis& axis : coarse.axes) {
    axis.points = axis.edge == danger::Edge::periodic ? axis.points / 2 : (axis.points + 1) / 2;
  }
  return danger::broken_rule(coarse) ? std::nullopt : std::optional(coarse);
}

Error another(const std::string& what, const std::string& begun, const std::string& wanted) {
  return {Error::Code::malformed,
          fmt::format("it was begun {} {}, wanted {}", what, begun, wanted)};
}

std::string described(const danger::Axis& axis) {
  return fmt::format("{} in [{}, {}], {} points, {}, stretch {}{}", axis.name, axis.first,
                     axis.last, axis.points, name_of(axis.edge, danger::edge_names), axis.stretch,
                     axis.turned ? fmt::format(", turning axis {}", *axis.turned + 1) : "");
}

/// nullopt: none.
std::optional<Error> another_grid(const danger::Grid& begun, const danger::Grid& wanted) {
  if (begun.axes.size() != wanted.axes.size()) {
    return another("on a grid of", fmt::format("{} axes", begun.axes.size()),
                   fmt::format("{}", wanted.axes.size()));
  }
  for (std::size_t d = 0; d < wanted.axes.size(); ++d) {
    if (begun.axes[d] != wanted.axes[d]) {
      return another("on another grid: with", described(begun.axes[d]), described(wanted.axes[d]));
    }
  }
  return std::nullopt;
}

/// Whether snapshots at `begun` are the first of those at `wanted`, but for where it was stopped.
bool are_first_of(const std::vector<double>& begun, const std::vector<double>& wanted) {
  const auto [left, right] =
      std::mismatch(begun.begin(), begun.end(), wanted.begin(), wanted.end());
  return left == begun.end() ||
         (left + 1 == begun.end() && right != wanted.end() && *left < *right);
}

bool fits_itself(const danger::Solution& begun) {
  return !begun.times.empty() &&
         std::visit(
             [&](const auto& snapshots) {
               return snapshots.size() == begun.times.size() &&
                      std::all_of(snapshots.begin(), snapshots.end(), [&](const auto& values) {
                        return values.size() == danger::num_cells(begun.grid);
                      });
             },
             begun.values);
}

/// Why `begun` cannot be gone on with.
std::optional<Error> other_problem(const Problem& problem, const Scheme& scheme,
                                   const danger::Solution& begun) {
  if (begun.problem != problem.text) {
    return Error{Error::Code::malformed, "it was begun for another problem"};
  }
  if (auto other = another_grid(begun.grid, problem.grid)) {
    return other;
  }
  const std::string wanted = described(scheme);
  if (begun.scheme != wanted || begun.doubles() != scheme.doubles) {
    return another("by", begun.scheme.empty() ? "a scheme that is not told" : begun.scheme, wanted);
  }
  if (!fits_itself(begun)) {
    return Error{Error::Code::malformed, "what was begun has not one value per time and cell"};
  }
  if (!are_first_of(begun.times, problem.times)) {
    return another("for snapshots at", fmt::format("{} s", fmt::join(begun.times, ", ")),
                   fmt::format("{} s", fmt::join(problem.times, ", ")));
  }
  return std::nullopt;
}

/// March through the times of a problem, with what is kept of it.
template <class Real>
class March {
 public:
  March(const Problem& problem, const Scheme& scheme, std::optional<danger::Solution> begun)
      : problem_(problem),
        solver_(problem.grid, flow_for<Real>(problem, problem.grid, scheme.differences),
                danger::sampled<Real>(problem.grid, problem.unsafe, scheme.threads,
                                      problem.unsafe_alike_last),
                settings_of(problem, scheme)) {
    solved_.grid = problem.grid;
    solved_.problem = problem.text;
    solved_.scheme = described(scheme);
    solved_.values = danger::Snapshots<Real>{};
    if (begun) {
      solved_ = std::move(*begun);
      solved_.complete = false;
      solved_.error.clear();
      solver_.resume(solved_.times.back(), kept().back());
      if (!std::binary_search(problem.times.begin(), problem.times.end(), solved_.times.back())) {
        solved_.times.pop_back();  // where it was stopped is no time that is wanted
        kept().pop_back();
      }
    }
  }

  /// @return  false when stopped
  Result<bool> to_the_end(const Onlooker& onlooker) {
    for (const double until : problem_.times) {
      while (solver_.time() < until) {
        if (const auto taken = solver_.step(until); !taken.has_value()) {
          return taken.error();
        }
        const bool there = solver_.time() >= until;
        const bool go_on = onlooker.step(solver_.time());
        if (there || !go_on) {
          keep();
          if (const auto problem = onlooker.keep(solved_)) {
            return *problem;
          }
        }
        if (!go_on) {
          return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] danger::Solution& solved() { return solved_; }

 private:
  danger::Snapshots<Real>& kept() { return std::get<danger::Snapshots<Real>>(solved_.values); }
  void keep() {
    solved_.times.push_back(solver_.time());
    kept().emplace_back(solver_.values().begin(), solver_.values().end());
  }

  const Problem& problem_;
  Solver<Real> solver_;
  danger::Solution solved_;
};

/// Solves it on another grid, to the last time only.
/// @return  nullopt: stopped
template <class Real>
Result<std::optional<danger::Solution>> solved_on(const danger::Grid& grid, Problem problem,
                                                  const Scheme& scheme, const Onlooker& onlooker) {
  problem.grid = grid;
  problem.times = {problem.times.back()};
  March<Real> march(problem, scheme, std::nullopt);
  const auto done = march.to_the_end({.step = onlooker.step});
  if (!done.has_value()) {
    return done.error();
  }
  return done.value() ? std::optional(std::move(march.solved())) : std::nullopt;
}

/// Distance of each value to what a table has there.
template <class Real>
std::vector<float> distances(const danger::Grid& grid, const std::vector<Real>& values,
                             const danger::ValueTable& table, int threads) {
  std::array<std::vector<double>, danger::max_dimensions> coordinates;
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    for (int i = 0; i < grid.axes[d].points; ++i) {
      coordinates[d].push_back(danger::coordinate(grid.axes[d], i));
    }
  }
  std::vector<float> found(values.size());
  const std::size_t row = coordinates[0].size();
  in_parallel(values.size() / row, threads, [&](std::size_t r) {
    const danger::Cell cell = danger::cell_at(grid, r * row);
    danger::State state{};
    for (std::size_t d = 1; d < grid.axes.size(); ++d) {
      state[d] = coordinates[d][static_cast<std::size_t>(cell[d])];
    }
    for (std::size_t i = 0; i < row; ++i) {
      state[0] = coordinates[0][i];
      const auto value = static_cast<double>(static_cast<float>(values[r * row + i]));
      found[r * row + i] = static_cast<float>(std::abs(table.at(state).value - value));
    }
  });
  return found;
}

/// The difference to the solution on half as many points; empty where there are too few.
/// @return  nullopt: stopped
template <class Real>
Result<std::optional<std::vector<float>>> error_of(const Problem& problem, const Scheme& scheme,
                                                   const danger::Solution& fine,
                                                   const Onlooker& onlooker) {
  const auto grid = coarser(problem.grid);
  if (!grid) {
    return std::optional<std::vector<float>>(std::in_place);
  }
  const auto coarse = solved_on<Real>(*grid, problem, scheme, onlooker);
  if (!coarse.has_value()) {
    return coarse.error();
  }
  if (!coarse.value()) {
    return std::optional<std::vector<float>>();
  }
  const danger::ValueTable table(*grid, danger::snapshot(*coarse.value(), 0));
  const auto& values = std::get<danger::Snapshots<Real>>(fine.values).back();
  return std::optional(distances(problem.grid, values, table, scheme.threads));
}

/// @return  as far as it came, and whether that is the end
template <class Real>
Result<std::pair<danger::Solution, bool>> marched(const Problem& problem, const Scheme& scheme,
                                                  std::optional<danger::Solution> begun,
                                                  const Onlooker& onlooker) {
  March<Real> march(problem, scheme, std::move(begun));
  const auto done = march.to_the_end(onlooker);
  if (!done.has_value()) {
    return done.error();
  }
  return std::pair(std::move(march.solved()), done.value());
}

template <class Real>
Result<danger::Solution> solve_in(const Problem& problem, const Scheme& scheme,
                                  std::optional<danger::Solution> begun, const Onlooker& onlooker) {
  auto there = marched<Real>(problem, scheme, std::move(begun), onlooker);  // its solver has gone
  if (!there.has_value()) {
    return there.error();
  }
  auto [solved, is_the_end] = std::move(there).value();
  if (!is_the_end) {
    return std::move(solved);
  }
  if (scheme.with_error) {
    auto error = error_of<Real>(problem, scheme, solved, onlooker);
    if (!error.has_value()) {
      return error.error();
    }
    if (!error.value()) {
      return std::move(solved);
    }
    solved.error = *std::move(error).value();
  }
  solved.complete = true;
  if (const auto wrong = onlooker.keep(solved)) {
    return *wrong;
  }
  return std::move(solved);
}

/// Whether nothing is left to be done.
bool is_all(const Problem& problem, const Scheme& scheme, const danger::Solution& begun) {
  return begun.complete && begun.times == problem.times &&
         (!scheme.with_error || !begun.error.empty() || !coarser(problem.grid));
}

}  // namespace

Problem air3d_problem(const danger::Grid& grid, const Air3d& game) {
  return {.text = fmt::format("system = \"air3d\"\nevader_speed_mps = {}\npursuer_speed_mps = {}\n"
                              "evader_turn_rate_radps = {}\npursuer_turn_rate_radps = {}\n"
                              "capture_radius_m = {}\n",
                              game.evader_speed, game.pursuer_speed, game.evader_turn_rate,
                              game.pursuer_turn_rate, game.capture_radius),
          .grid = grid,
          .times = {2.8},
          .tube = Tube::tube,
          .unsafe = [game](std::span<const double> state) { return intrusion(game, state); },
          .in_floats =
              [game](const danger::Grid& on, Differences differences) {
                return own_flow<float>(on, game, differences);
              },
          .in_doubles =
              [game](const danger::Grid& on, Differences differences) {
                return own_flow<double>(on, game, differences);
              }};
}

Problem avoidance_problem(const danger::AvoidanceCase& asked) {
  Problem problem{.text = asked.text,
                  .grid = asked.grid,
                  .times = asked.times,
                  .tube = Tube::highest,
                  .unsafe =
                      [asked](std::span<const double> x) {
                        danger::State state{};
                        std::copy(x.begin(), x.end(), state.begin());
                        return danger::intrusion_at(asked, state);
                      },
                  .unsafe_alike_last = true,  // it is the speed
                  .in_floats = {},
                  .in_doubles = {}};
  const auto set_flows = [&](const auto& system) {
    problem.in_floats = [system](const danger::Grid& on, Differences differences) {
      return own_flow<float>(on, system, differences);
    };
    problem.in_doubles = [system](const danger::Grid& on, Differences differences) {
      return own_flow<double>(on, system, differences);
    };
  };
  switch (asked.view) {
    case danger::View::obstacle:
      set_flows(asked.system);
      break;
    case danger::View::ego:
      set_flows(danger::AvoidanceAhead{asked.system});
      break;
    case danger::View::edge:
      set_flows(danger::EdgeAvoidance{asked.system});
      break;
  }
  return problem;
}

Scheme danger_scheme(int threads) {
  return {.steps = Steps::tvd_rk2, .cfl = 0.9, .threads = threads};
}

std::string described(const Scheme& scheme) {
  constexpr int solver = 1;
  return fmt::format("{}, {}, cfl {}, {}, solver {}", name_of(scheme.differences, difference_names),
                     name_of(scheme.steps, step_names), scheme.cfl,
                     scheme.doubles ? "doubles" : "floats", solver);
}

std::size_t memory_needed(const Problem& problem, const Scheme& scheme) {
  constexpr std::size_t around = std::size_t{12} << 20;  // libraries, threads, compressing
  const std::size_t bytes = scheme.doubles ? sizeof(double) : sizeof(float);
  const Settings settings = settings_of(problem, scheme);
  const std::size_t cells = danger::num_cells(problem.grid);
  const std::size_t snapshots = problem.times.size() * cells * bytes;
  const std::size_t error = scheme.with_error ? cells * sizeof(float) : 0;
  // While it marches: beside the solver h, before it is handed over, or the snapshots' file; where
  // it was stopped is one of the snapshots.
  const std::size_t marching =
      memory_needed(problem.grid, bytes, settings) + snapshots + snapshots / 32;
  std::size_t comparing = 0;
  if (const auto coarse = scheme.with_error ? coarser(problem.grid) : std::nullopt) {
    const std::size_t values = danger::num_cells(*coarse) * bytes;
    const std::size_t table =
        danger::ValueTable::memory_needed(*coarse) + danger::num_cells(*coarse) * sizeof(float);
    comparing = std::max(memory_needed(*coarse, bytes, settings) + values, values + table + error);
  }
  const std::size_t keeping = error + (snapshots + error) / 32 * 33;  // and the file of all
  return snapshots + std::max({marching, comparing, keeping}) + around;
}

Result<danger::Solution> solve(const Problem& problem, const Scheme& scheme,
                               std::optional<danger::Solution> begun, const Onlooker& onlooker) {
  expects(!problem.times.empty() && problem.times.front() > 0.0 &&
              std::is_sorted(problem.times.begin(), problem.times.end()) &&
              std::isfinite(problem.times.back()),
          "times > 0, rising");
  if (begun) {
    if (const auto problem_of_it = other_problem(problem, scheme, *begun)) {
      return *problem_of_it;
    }
    if (is_all(problem, scheme, *begun)) {
      return *std::move(begun);
    }
  }
  return scheme.doubles ? solve_in<double>(problem, scheme, std::move(begun), onlooker)
                        : solve_in<float>(problem, scheme, std::move(begun), onlooker);
}

}  // namespace saca::levelset
