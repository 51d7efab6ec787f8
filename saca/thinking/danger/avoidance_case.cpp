#include "saca/thinking/danger/avoidance_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <span>

#include "saca/base/config/config.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/thinking/danger/avoidance_ahead.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::danger {
namespace {

using config::Table;

constexpr double pi = std::numbers::pi;
constexpr int most_points = 2'000;  // of an axis

/// @param edge_name  an obstacle's shape beside those of footprints; empty: none is allowed
std::optional<world::Footprint> case_footprint(Table& table, std::string_view edge_name) {
  const std::string word = table.text("shape");
  if (!edge_name.empty() && word == edge_name) {
    return std::nullopt;
  }
  const auto shape = world::shape_from(word);
  if (!shape) {
    table.reject("shape", fmt::format("want box, ellipse, segment{}{}, got {}",
                                      edge_name.empty() ? "" : ", ", edge_name, word));
  }
  world::Footprint footprint{.shape = shape.value_or(world::Shape::box)};
  footprint.length = table.number("length_m", {0.1, 40.0});
  if (footprint.shape != world::Shape::segment) {
    footprint.width = table.number("width_m", {0.1, 20.0});
  }
  return footprint;
}

int case_points(Table& table) {
  return static_cast<int>(table.integer("points", 4, most_points));
}

Axis place_axis(Table table, std::string_view name, bool mirrored) {
  Axis axis{.name = std::string(name)};
  axis.first = mirrored ? 0.0 : table.number("first_m", {-1'000.0, 1'000.0});
  axis.last = table.number("last_m", {-1'000.0, 1'000.0});
  axis.points = case_points(table);
  axis.stretch = table.optional_number("stretch_m", {0.1, 10'000.0}).value_or(0.0);
  if (!(axis.last > axis.first)) {
    table.reject("last_m", fmt::format("want more than {}, got {}", axis.first, axis.last));
  }
  return axis;
}

/// A direction: all around.
Axis angle_axis(Table table, std::string_view name) {
  return {.name = std::string(name),
          .first = -pi,
          .last = pi,
          .points = case_points(table),
          .edge = Edge::periodic};
}

Axis speed_axis(Table table) {
  Axis axis{.name = "speed"};
  axis.last = table.number("last_mps", {1.0, 100.0});
  axis.points = case_points(table);
  axis.stretch = table.optional_number("stretch_mps", {0.1, 10'000.0}).value_or(0.0);
  return axis;
}

Grid case_grid(Table table, View view) {
  const bool is_ego = view == View::ego;
  const std::string_view along = is_ego ? "ahead" : "x";
  const std::string_view across = is_ego ? "left" : "y";
  const std::string_view angle = is_ego ? "turned" : "course";
  Grid grid;
  if (view != View::edge) {
    grid.axes.push_back(place_axis(table.table(along), along, false));
  }
  grid.axes.push_back(place_axis(table.table(across), across, view != View::edge));
  if (view != View::edge) {  // left and right are alike
    grid.axes.back().edge = Edge::mirrored;
    grid.axes.back().turned = 2;
  }
  grid.axes.push_back(angle_axis(table.table(angle), angle));
  grid.axes.push_back(speed_axis(table.table("speed")));
  return grid;
}

Avoidance case_system(Table table) {
  Avoidance system;
  system.grip = table.number("grip", {0.05, 1.5});
  system.tightest_curvature = table.number("tightest_curvature_1pm", {0.01, 1.0});
  system.drive_share = table.number("drive_share", {0.0, 1.0});
  return system;
}

std::vector<double> case_times(Table& root) {
  std::vector<double> times = root.numbers("snapshots_s", {0.01, 100.0});
  if (times.empty()) {
    root.reject("snapshots_s", "want at least one time");
  }
  const auto not_rising =
      std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return a >= b; });
  if (not_rising != times.end()) {
    root.reject("snapshots_s", fmt::format("want rising times, got {} before {}", *not_rising,
                                           *std::next(not_rising)));
  }
  return times;
}

View case_view(Table& root, bool beside_edge) {
  if (beside_edge) {
    return View::edge;
  }
  const std::string word = root.text("seen_from");
  if (word != "ego" && word != "obstacle") {
    root.reject("seen_from", fmt::format("want ego or obstacle, got {}", word));
  }
  return word == "ego" ? View::ego : View::obstacle;
}

State padded_state(std::span<const double> entries) {
  State state{};
  std::copy(entries.begin(), entries.end(), state.begin());
  return state;
}

}  // namespace

Result<AvoidanceCase> read_avoidance_case(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return parse_avoidance_case(text.value(), path.string());
}

Result<AvoidanceCase> parse_avoidance_case(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  AvoidanceCase problem;
  root.want_schema("saca.avoidance/1");
  problem.name = root.plain_name("name");
  problem.text = text;
  problem.times = case_times(root);
  problem.system = case_system(root.table("car"));
  Table ego = root.table("ego");
  problem.ego = case_footprint(ego, "").value_or(world::Footprint{});
  problem.ego.centre_x = ego.number("centre_m", {-20.0, 20.0});
  Table obstacle = root.table("obstacle");
  problem.obstacle = case_footprint(obstacle, "left_edge");
  if (problem.obstacle) {
    problem.system.obstacle_speed =
        obstacle.number("speed_mps", {-fastest_obstacle, fastest_obstacle});
  }
  problem.view = case_view(root, !problem.obstacle);
  problem.grid = case_grid(root.table("grid"), problem.view);
  if (const auto error = document.value().error(); error.has_value()) {
    return *error;
  }
  if (const auto broken = broken_rule(problem.grid)) {
    return Error{Error::Code::malformed, fmt::format("{}: {}", source, *broken)};
  }
  return problem;
}

State grid_state(View view, const State& state) {
  switch (view) {
    case View::ego:
      return seen_by_ego(state);
    case View::edge:
      return {state[1], state[2], state[3], 0.0};
    case View::obstacle:
      break;
  }
  return state;
}

double intrusion_at(const AvoidanceCase& problem, const State& state) {
  expects(problem.obstacle.has_value() == (problem.view != View::edge), "the view fits");
  if (problem.view == View::edge) {
    return intrusion(problem.ego, {{0.0, state[0]}, state[1]}, HalfPlane{});
  }
  const Pose X{{state[0], state[1]}, state[2]};
  return problem.view == View::ego ? intrusion(problem.ego, {}, *problem.obstacle, X)
                                   : intrusion(problem.ego, X, *problem.obstacle, {});
}

template <class Real>
std::vector<Real> unsafe(const AvoidanceCase& problem, int threads) {
  const auto h = [&](std::span<const double> place) {
    return intrusion_at(problem, padded_state(place));
  };
  return sampled<Real>(problem.grid, h, threads, true);  // at any speed
}

template std::vector<float> unsafe(const AvoidanceCase&, int);
template std::vector<double> unsafe(const AvoidanceCase&, int);

}  // namespace saca::danger
