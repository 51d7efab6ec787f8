#include "saca/thinking/danger/danger_cases.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::danger {
namespace {

using world::Footprint;
using world::Shape;

struct StandardBody {
  std::string_view name;
  Footprint footprint;
};

// Sizes: a person with room for arms and a step's swing, to which a bicycle is added by what it is
// longer; the passenger car as in data/vehicles; a lorry and an articulated one within the EU's
// limits (directive 96/53/EC: 12 m, 16.5 m, 2.55 m wide).
constexpr std::array<StandardBody, 4> standard_bodies{
    {{"person", {.shape = Shape::ellipse, .length = 1.0, .width = 1.0}},
     {"car", {.shape = Shape::box, .length = 4.8, .width = 1.9}},
     {"truck", {.shape = Shape::box, .length = 10.0, .width = 2.55}},
     {"articulated", {.shape = Shape::box, .length = 16.5, .width = 2.55}}}};

constexpr double speed_step = 5.0;  // [m/s]: see the decision named in the header
constexpr double faster = 1.0;      // [m/s]: by perception's noise, or in a forecast

const StandardBody& nearest_body(const Footprint& obstacle) {
  return *std::min_element(standard_bodies.begin(), standard_bodies.end(),
                           [&](const StandardBody& a, const StandardBody& b) {
                             return misfit(obstacle, a.footprint) < misfit(obstacle, b.footprint);
                           });
}

std::string text_of(std::string_view title, const Avoidance& car, const Footprint& ego,
                    const Footprint& obstacle, double speed) {
  std::string text;
  const auto to = std::back_inserter(text);
  fmt::format_to(to, "schema = \"saca.avoidance/1\"\nname = \"{}\"\n", title);
  fmt::format_to(to, "seen_from = \"ego\"\nsnapshots_s = [4.0]\n\n");
  fmt::format_to(to, "[car]\ngrip = {}\ntightest_curvature_1pm = {}\ndrive_share = {}\n\n",
                 car.grip, car.tightest_curvature, car.drive_share);
  const auto add_body = [&](const Footprint& body) {
    fmt::format_to(to, "shape = \"{}\"\nlength_m = {}\n", name(body.shape), body.length);
    if (body.shape != Shape::segment) {
      fmt::format_to(to, "width_m = {}\n", body.width);
    }
  };
  fmt::format_to(to, "[ego]\n");
  add_body(ego);
  fmt::format_to(to, "centre_m = {}\n\n[obstacle]\n", ego.centre_x);
  add_body(obstacle);
  fmt::format_to(to, "speed_mps = {}\n\n", speed);
  fmt::format_to(to,
                 "[grid.ahead]\nfirst_m = -14.0\nlast_m = 60.0\npoints = 48\nstretch_m = 12.0\n\n");
  fmt::format_to(to, "[grid.left]\nlast_m = 30.0\npoints = 26\nstretch_m = 6.0\n\n");
  fmt::format_to(to, "[grid.turned]\npoints = 36\n\n[grid.speed]\nlast_mps = 30.0\npoints = 13\n");
  return text;
}

}  // namespace

Result<std::vector<DangerCase>> danger_cases(const Avoidance& car, const Footprint& ego,
                                             double grip, std::span<const ObstacleKind> wanted) {
  const double speed_factor = scaled_to({.grip = std::min(grip, car.grip)}, car.grip).speed_factor;
  std::array<double, standard_bodies.size()> top_speeds;
  top_speeds.fill(-1.0);  // not wanted
  for (const ObstacleKind& one : wanted) {
    expects(one.top_speed >= 0.0 && std::isfinite(one.top_speed), "top_speed >= 0");
    const auto body =
        static_cast<std::size_t>(&nearest_body(one.obstacle) - standard_bodies.data());
    top_speeds[body] = std::max(top_speeds[body], one.top_speed * speed_factor);
  }
  std::vector<DangerCase> cases;
  for (std::size_t body = 0; body < standard_bodies.size(); ++body) {
    const StandardBody& of = standard_bodies[body];
    constexpr double rounding = 1e-6;
    const double top = top_speeds[body] > 0.0
                           ? std::min(top_speeds[body] + faster, fastest_obstacle)
                           : top_speeds[body];
    const int steps = top < 0.0 ? -1 : static_cast<int>(std::ceil(top / speed_step - rounding));
    for (int i = 0; i <= steps; ++i) {
      const double speed = i * speed_step;
      std::string title = fmt::format("{}_{}mps", of.name, speed);
      auto asked = parse_avoidance_case(text_of(title, car, ego, of.footprint, speed), title);
      if (!asked.has_value()) {
        return Error{asked.error().code, "danger of " + asked.error().message};
      }
      cases.push_back({std::move(title), std::move(asked).value()});
    }
  }
  return cases;
}

}  // namespace saca::danger
