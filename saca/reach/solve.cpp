#include "saca/reach/solve.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "saca/core/contract.h"
#include "saca/reach/own_systems.h"
#include "saca/reach/value_table.h"

namespace saca::reach {
namespace {

template <class Real>
Flow<Real> flow_for(const Problem& problem, const Grid& grid, Differences differences) {
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
std::optional<Grid> coarser(const Grid& grid) {
  Grid coarse = grid;
  for (Axis& axis : coarse.axes) {
    axis.points = axis.edge == Edge::periodic ? axis.points / 2 : (axis.points + 1) / 2;
  }
  return broken_rule(coarse) ? std::nullopt : std::optional(coarse);
}

/// Whether `begun` can be gone on with.
std::optional<Error> other_problem(const Problem& problem, const Scheme& scheme,
                                   const Solved& begun) {
  if (begun.problem != problem.text) {
    return Error{Error::Code::malformed, "it was begun for another problem"};
  }
  if (begun.doubles() != scheme.doubles) {
    return Error{Error::Code::malformed, "it was begun in the other precision"};
  }
  return std::nullopt;
}

/// March through the times of a problem, with what is kept of it.
template <class Real>
class March {
 public:
  March(const Problem& problem, const Scheme& scheme, std::optional<Solved> begun)
      : problem_(problem),
        solver_(problem.grid, flow_for<Real>(problem, problem.grid, scheme.differences),
                sampled<Real>(problem.grid, problem.unsafe, scheme.threads),
                settings_of(problem, scheme)) {
    solved_.grid = problem.grid;
    solved_.problem = problem.text;
    solved_.values = Snapshots<Real>{};
    if (begun) {
      solved_ = std::move(*begun);
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

  [[nodiscard]] Solved& solved() { return solved_; }

 private:
  Snapshots<Real>& kept() { return std::get<Snapshots<Real>>(solved_.values); }
  void keep() {
    solved_.times.push_back(solver_.time());
    kept().emplace_back(solver_.values().begin(), solver_.values().end());
  }

  const Problem& problem_;
  Solver<Real> solver_;
  Solved solved_;
};

/// The difference to the solution on half as many points; empty where there are too few.
/// @return  nullopt: stopped
template <class Real>
Result<std::optional<std::vector<float>>> error_of(const Problem& problem, const Scheme& scheme,
                                                   const Solved& fine, const Onlooker& onlooker) {
  const auto grid = coarser(problem.grid);
  if (!grid) {
    return std::optional<std::vector<float>>(std::in_place);
  }
  Problem coarse = problem;
  coarse.grid = *grid;
  coarse.times = {problem.times.back()};
  March<Real> march(coarse, scheme, std::nullopt);
  const auto done = march.to_the_end({.step = onlooker.step});
  if (!done.has_value()) {
    return done.error();
  }
  if (!done.value()) {
    return std::optional<std::vector<float>>();
  }
  const ValueTable table(*grid, snapshot(march.solved(), 0));
  const std::vector<float> values = snapshot(fine, fine.times.size() - 1);
  std::vector<float> error(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double other = table.at(state_at(problem.grid, i)).value;
    error[i] = static_cast<float>(std::abs(other - static_cast<double>(values[i])));
  }
  return std::optional(std::move(error));
}

template <class Real>
Result<Solved> solve_in(const Problem& problem, const Scheme& scheme, std::optional<Solved> begun,
                        const Onlooker& onlooker) {
  March<Real> march(problem, scheme, std::move(begun));
  const auto done = march.to_the_end(onlooker);
  if (!done.has_value()) {
    return done.error();
  }
  Solved solved = std::move(march.solved());
  if (!done.value()) {
    return solved;
  }
  if (scheme.with_error && solved.error.empty()) {
    auto error = error_of<Real>(problem, scheme, solved, onlooker);
    if (!error.has_value()) {
      return error.error();
    }
    if (!error.value()) {
      return solved;
    }
    solved.error = *std::move(error).value();
  }
  solved.complete = true;
  if (const auto wrong = onlooker.keep(solved)) {
    return *wrong;
  }
  return solved;
}

}  // namespace

Problem air3d_problem(const Grid& grid, const Air3d& game) {
  return {.text = "system = \"air3d\"\n",
          .grid = grid,
          .times = {2.8},
          .tube = Tube::tube,
          .unsafe = [game](std::span<const double> state) { return intrusion(game, state); },
          .in_floats =
              [game](const Grid& on, Differences differences) {
                return own_flow<float>(on, game, differences);
              },
          .in_doubles =
              [game](const Grid& on, Differences differences) {
                return own_flow<double>(on, game, differences);
              }};
}

Problem avoidance_problem(const AvoidanceCase& asked, std::string text) {
  Problem problem{.text = std::move(text),
                  .grid = asked.grid,
                  .times = asked.snapshots,
                  .tube = Tube::highest,
                  .unsafe =
                      [asked](std::span<const double> x) {
                        State state{};
                        std::copy(x.begin(), x.end(), state.begin());
                        return intrusion_at(asked, state);
                      },
                  .in_floats = {},
                  .in_doubles = {}};
  if (problem.times.empty() || problem.times.back() < asked.horizon) {
    problem.times.push_back(asked.horizon);
  }
  const auto set_flows = [&](const auto& system) {
    problem.in_floats = [system](const Grid& on, Differences differences) {
      return own_flow<float>(on, system, differences);
    };
    problem.in_doubles = [system](const Grid& on, Differences differences) {
      return own_flow<double>(on, system, differences);
    };
  };
  if (asked.obstacle) {
    set_flows(asked.system);
  } else {
    set_flows(EdgeAvoidance{asked.system});
  }
  return problem;
}

std::size_t memory_needed(const Problem& problem, const Scheme& scheme) {
  const std::size_t bytes = scheme.doubles ? sizeof(double) : sizeof(float);
  // Beside the solver: h while it is handed over, the snapshots, and writing one of them.
  return memory_needed(problem.grid, bytes, settings_of(problem, scheme)) +
         (problem.times.size() + 2) * num_cells(problem.grid) * bytes;
}

Result<Solved> solve(const Problem& problem, const Scheme& scheme, std::optional<Solved> begun,
                     const Onlooker& onlooker) {
  expects(!problem.times.empty() && problem.times.front() > 0.0 &&
              std::is_sorted(problem.times.begin(), problem.times.end()) &&
              std::isfinite(problem.times.back()),
          "times > 0, rising");
  if (begun) {
    if (const auto problem_of_it = other_problem(problem, scheme, *begun)) {
      return *problem_of_it;
    }
    if (begun->complete) {
      return *std::move(begun);
    }
  }
  return scheme.doubles ? solve_in<double>(problem, scheme, std::move(begun), onlooker)
                        : solve_in<float>(problem, scheme, std::move(begun), onlooker);
}

}  // namespace saca::reach
