#include "saca/lab/verification/convergence.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/levelset/solver.h"
#include "saca/lab/verification/known_systems.h"

namespace saca::verification {
namespace {

/// A problem with a known answer.
struct ReferenceProblem {
  std::string name;
  std::function<danger::Grid(int points)> grid;
  std::function<levelset::Flow<double>(const danger::Grid&)> flow;
  std::function<double(std::span<const double>)> h;
  std::function<double(const danger::State&)> answer;
  std::function<bool(const danger::State&)> counts;
  double horizon = 1.0;
  levelset::Settings settings;
};

danger::Grid square_of(double half, int points, danger::Edge edge) {
  danger::Axis axis{.name = "x", .first = -half, .last = half, .points = points, .edge = edge};
  danger::Grid grid{{axis, axis}};
  grid.axes[1].name = "y";
  return grid;
}

double error_on(const ReferenceProblem& known, const danger::Grid& grid) {
  levelset::Solver<double> solver(grid, known.flow(grid),
                                  danger::sampled<double>(grid, known.h, known.settings.threads),
                                  known.settings);
  while (solver.time() < known.horizon) {
    expects(solver.step(known.horizon).has_value(), "known problems have numbers everywhere");
  }
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < solver.values().size(); ++i) {
    const danger::State x = danger::state_at(grid, i);
    if (known.counts(x)) {
      sum += std::abs(solver.values()[i] - known.answer(x));
      count += 1.0;
    }
  }
  return sum / count;
}

ReferenceProblem carried(std::string_view name, levelset::Differences differences) {
  const ConstantMotion motion{1.0, -0.5};
  // Its extrema wander over the grid; the steps are short beside the differences of fifth order.
  const auto value = [](double x, double y) { return std::sin(x) * std::cos(y); };
  return {
      .name = "a wave carried along, " + std::string(name),
      .grid =
          [](int points) {
            return square_of(std::numbers::pi, points - 1, danger::Edge::periodic);
          },
      .flow =
          [=](const danger::Grid& grid) { return known_flow<double>(grid, motion, differences); },
      .h = [=](std::span<const double> x) { return value(x[0], x[1]); },
      .answer = [=](const danger::State& x) { return value(x[0] + motion.vx, x[1] + motion.vy); },
      .counts = [](const danger::State&) { return true; },
      .horizon = 1.0,
      .settings = {.tube = levelset::Tube::set, .cfl = 0.1}};
}

ReferenceProblem disc_that(std::string_view does, double speed) {
  const auto radius = [](double x, double y) { return std::hypot(x, y); };
  return {.name = "a disc that " + std::string(does) + ", WENO5",
          .grid = [](int points) { return square_of(2.0, points, danger::Edge::open); },
          .flow =
              [=](const danger::Grid& grid) {
                return known_flow<double>(grid, AnyDirection<2>{speed});
              },
          .h = [=](std::span<const double> x) { return 1.0 - radius(x[0], x[1]); },
          .answer = [=](const danger::State& x) { return 1.0 - radius(x[0], x[1]) + 0.5 * speed; },
          .counts =
              [=](const danger::State& x) {
                const double r = radius(x[0], x[1]);
                return r > 1.0 && r < 1.5;  // off the tip and its rounding, and off the edges
              },
          .horizon = 0.5,
          .settings = {.tube = levelset::Tube::set}};
}

ReferenceProblem braking_before_a_wall() {
  const auto answer = [](const danger::State& x) {
    const double v = std::max(0.0, x[1]);
    return x[0] + 0.5 * v * v;
  };
  return {
      .name = "braking before a wall, WENO5",
      .grid =
          [](int points) {
            danger::Grid grid = square_of(1.0, points, danger::Edge::open);
            grid.axes[0].first = -6.0;
            grid.axes[0].last = 2.0;
            grid.axes[1].name = "v";
            grid.axes[1].first = -2.0;
            grid.axes[1].last = 3.0;
            return grid;
          },
      .flow =
          [](const danger::Grid& grid) { return known_flow<double>(grid, DoubleIntegrator{1.0}); },
      .h = [](std::span<const double> x) { return x[0]; },
      .answer = answer,
      .counts =
          [=](const danger::State& x) { return answer(x) < 1.5; },  // within the grid to its end
      .horizon = 4.0,
      .settings = {}};
}

}  // namespace

std::vector<double> orders(const Refinement& refinement) {
  std::vector<double> found;
  for (std::size_t i = 1; i < refinement.errors.size(); ++i) {
    found.push_back(std::log(refinement.errors[i - 1] / refinement.errors[i]) /
                    std::log(refinement.spacings[i - 1] / refinement.spacings[i]));
  }
  return found;
}

std::vector<Refinement> refinements(int grids, int threads) {
  expects(grids >= 2 && grids <= 5, "2 to 5 grids");
  std::vector<ReferenceProblem> problems{carried("upwind", levelset::Differences::upwind1),
                                         carried("ENO2", levelset::Differences::eno2),
                                         carried("ENO3", levelset::Differences::eno3),
                                         carried("WENO5", levelset::Differences::weno5),
                                         disc_that("grows", 1.0),
                                         disc_that("shrinks", -1.0),
                                         braking_before_a_wall()};
  std::vector<Refinement> all;
  for (ReferenceProblem& known : problems) {
    known.settings.threads = threads;
    Refinement one{known.name, {}, {}};
    for (int i = 0, cells = 20; i < grids; ++i, cells *= 2) {
      const danger::Grid grid = known.grid(cells + 1);
      one.spacings.push_back(danger::spacing(grid.axes[0], 0));
      one.errors.push_back(error_on(known, grid));
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace saca::verification
