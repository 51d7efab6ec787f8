// Longer than 400 lines: one look-up, from a plan and a scene to a path: several in each step of
// the reflex plane, compiled together.
#include "saca/onboard/atlas/atlas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/base/core/simd_level.h"
#include "saca/base/world/road.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::atlas {
namespace {

constexpr std::array<std::string_view, num_atlas_kinds> kind_names{
    "stop", "keep", "swerve", "braked swerve", "swerve to rest", "drift"};
constexpr std::array<std::string_view, 12> limit_names{
    "no finite number", "speed",    "grip",         "lane width", "target speed", "heading",
    "lateral speed",    "yaw rate", "acceleration", "offset",     "curvature",    "strength"};

// As the controller has it: slower targets are stops [m/s].
constexpr double least_kept = 0.5;

AtlasAxes::Axis axis(std::initializer_list<double> values) {
  AtlasAxes::Axis axis;
  for (const double value : values) {
    axis.push_back(value);
  }
  return axis;
}

void add_range(AtlasAxes::Axis& axis, double from, double to, double step) {
  const int count = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= count; ++i) {
    axis.push_back(from + i * step);
  }
}

// The cell of an axis that holds a value, and where in it.
struct Cell {
  std::size_t low = 0;
  std::size_t high = 0;
  double share = 0.0;  // of `high`
};

Cell cell_of(const AtlasAxes::Axis& axis, double value, bool inverse = false) noexcept {
  const std::size_t last = axis.size() - 1;
  std::size_t i = 0;
  while (i + 1 < last && axis[i + 1] <= value) {
    ++i;
  }
  if (last == 0 || !(value > axis[i])) {
    return {i, i, 0.0};
  }
  const auto place = [&](double at) { return inverse ? 1.0 / at : at; };
  const double share = (place(value) - place(axis[i])) / (place(axis[i + 1]) - place(axis[i]));
  return share >= 1.0 ? Cell{i + 1, i + 1, 0.0} : Cell{i, i + 1, share};
}

bool spans(const AtlasAxes::Axis& axis, double value) noexcept {
  constexpr double rounding = 1e-9;
  return value >= axis[0] - rounding && value <= axis[axis.size() - 1] + rounding;
}

// An axis of one value is none.
bool holds(const AtlasAxes::Axis& axis, double value) noexcept {
  return axis.size() == 1 || spans(axis, value);
}

// y, heading and what they gain change sign in the mirror; x does not.
constexpr std::array<bool, 6> mirrored{false, true, true, false, true, true};

// Adds the weighted channels of a node to those of a path.
[[gnu::always_inline]] inline void add_channels(const AtlasNode& node, double weight, int side,
                                                bool with_sensitivity, AtlasPath& path) noexcept {
  for (std::size_t c = 0; c < 6; ++c) {
    const double sign = mirrored[c] ? side : 1.0;
    const auto factor = static_cast<float>(sign * weight) * node.scale[c];
    for (std::size_t i = 0; i < atlas_samples; ++i) {
      path.channel[c][i] += factor * static_cast<float>(node.path[c][i]);
    }
  }
  for (std::size_t c = 0; c < 6 && with_sensitivity; ++c) {
    const double sign = mirrored[c % 3] ? side : 1.0;
    const auto factor = static_cast<float>(sign * weight) * node.sensitivity_scale[c];
    for (std::size_t i = 0; i < sensitivity_samples; ++i) {
      path.sensitivity[c][i] += factor * static_cast<float>(node.sensitivity[c][i]);
    }
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void add_channels_in_avx2(const AtlasNode& node, double weight, int side,
                                                  bool with_sensitivity, AtlasPath& path) noexcept {
  add_channels(node, weight, side, with_sensitivity, path);
}
#endif

// The same numbers on each instruction set: no operation is fused or put in another order.
void add_node(const AtlasNode& node, double weight, int side, bool with_sensitivity,
              AtlasPath& path) noexcept {
#if defined(__x86_64__)
  if (available(SimdLevel::avx2)) {
    add_channels_in_avx2(node, weight, side, with_sensitivity, path);
  } else {
    add_channels(node, weight, side, with_sensitivity, path);
  }
#else
  add_channels(node, weight, side, with_sensitivity, path);
#endif
  path.span += weight * static_cast<double>(node.span);
  path.end += weight * static_cast<double>(node.end);
  path.sensitivity_span += weight * static_cast<double>(node.sensitivity_span);
  path.ended = path.ended && node.ended != 0;
}

// Cubic through the ends of an interval with what the value gains per sample there.
struct Hermite {
  double value;
  double gain;
};
Hermite hermite(double p, double q, double m, double n, double u) noexcept {
  const double rise = q - p;
  const double a = m + n - 2.0 * rise;
  const double b = 3.0 * rise - 2.0 * m - n;
  return {p + u * (m + u * (b + u * a)), m + u * (2.0 * b + 3.0 * u * a)};
}

AtlasInstant within(const AtlasPath& path, double time) noexcept {
  const double per_second =
      path.span > 0.0 ? static_cast<double>(atlas_samples - 1) / path.span : 0.0;
  const double place = std::clamp(time * per_second, 0.0, static_cast<double>(atlas_samples - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), atlas_samples - 2);
  const double u = place - static_cast<double>(i);
  std::array<Hermite, 3> h{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& p = path.channel[c];
    const auto& m = path.channel[c + 3];
    h[c] = hermite(static_cast<double>(p[i]), static_cast<double>(p[i + 1]),
                   static_cast<double>(m[i]), static_cast<double>(m[i + 1]), u);
  }
  return {h[0].value,
          h[1].value,
          h[2].value,
          per_second * h[0].gain,
          per_second * h[1].gain,
          per_second * h[2].gain};
}

// Lays a way along a bend: on the inside the same speed gets farther along the middle.
void bend(AtlasPath& path) noexcept {
  const double k = path.curvature;
  auto& x = path.channel[0];
  auto& gain = path.channel[3];
  const auto& y = path.channel[1];
  const auto& across = path.channel[4];
  const auto stretch = [&](double d) { return 1.0 / (1.0 - k * (path.start_d + d)); };
  std::array<float, atlas_samples> bent{};
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < atlas_samples; ++i) {
    const auto value = [i](const auto& c, std::size_t ahead) {
      return static_cast<double>(c[i + ahead]);
    };
    const double middle_gain =
        hermite(value(x, 0), value(x, 1), value(gain, 0), value(gain, 1), 0.5).gain;
    const double middle_y =
        hermite(value(y, 0), value(y, 1), value(across, 0), value(across, 1), 0.5).value;
    bent[i] = static_cast<float>(way);
    way += (value(gain, 0) * stretch(value(y, 0)) + 4.0 * middle_gain * stretch(middle_y) +
            value(gain, 1) * stretch(value(y, 1))) /
           6.0;  // Simpson
  }
  bent[atlas_samples - 1] = static_cast<float>(way);
  x = bent;
  for (std::size_t i = 0; i < atlas_samples; ++i) {
    gain[i] = static_cast<float>(static_cast<double>(gain[i]) * stretch(static_cast<double>(y[i])));
  }
}

// Where a plan stands on the axis of its kind's shares.
double share_of(const manoeuvre::Plan& plan, AtlasKind kind, double speed) noexcept {
  if (kind == AtlasKind::stop) {
    return manoeuvre::strength_of(plan);
  }
  return kind == AtlasKind::braked_swerve ? plan.target_speed.value_or(0.0) / std::max(speed, 1e-3)
                                          : 0.0;
}

double way_to_go(const manoeuvre::Plan& plan, const world::Scene& scene) noexcept {
  const double d = to_lane(scene.road, scene.ego.X_WB).d;
  return scene.road.lane_width - manoeuvre::side(plan.policy) * d;
}

bool is_finite(const world::Scene& scene) noexcept {
  const world::EgoState& ego = scene.ego;
  return saca::is_finite(ego.X_WB) && saca::is_finite(ego.v_B) && saca::is_finite(ego.a_B) &&
         std::isfinite(ego.yaw_rate + scene.grip + scene.road.curvature + scene.road.lane_width) &&
         saca::is_finite(scene.road.X_WL);
}

std::optional<AtlasLimit> off_straight(const manoeuvre::Plan& plan, const world::Scene& scene,
                                       const AtlasBounds& bounds) noexcept {
  const world::EgoState& ego = scene.ego;
  const world::LanePose pose = to_lane(scene.road, ego.X_WB);
  const double bend = scene.road.curvature * ego.v_B.x;
  if (!(std::abs(pose.heading) <= bounds.heading)) {
    return AtlasLimit::heading;
  }
  if (!(std::abs(ego.v_B.y) <= bounds.lateral_speed)) {
    return AtlasLimit::lateral_speed;
  }
  if (!(std::abs(ego.yaw_rate - bend) <= bounds.yaw_rate)) {
    return AtlasLimit::yaw_rate;
  }
  if (!(norm(ego.a_B - Vec2{0.0, bend * ego.v_B.x}) <= bounds.acceleration)) {
    return AtlasLimit::acceleration;
  }
  if (!(std::abs(pose.d) <= bounds.offset)) {
    return AtlasLimit::offset;
  }
  const bool hard = manoeuvre::brakes_to_speed(plan.policy) || manoeuvre::drifts(plan.policy);
  const double share = hard ? bounds.hard_bend_share : bounds.bend_share;
  if (!(std::abs(bend * ego.v_B.x) <= share * scene.grip * vehicle::gravity)) {
    return AtlasLimit::curvature;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(AtlasKind kind) {
  return name_of(kind, kind_names);
}
std::string_view name(AtlasLimit limit) {
  return name_of(limit, limit_names);
}

std::size_t num_nodes(const AtlasGrid& grid) {
  std::size_t count = 0;
  for (const AtlasAxes& axes : grid) {
    count += axes.num_nodes();
  }
  return count;
}

AtlasGrid default_atlas_grid() {
  const AtlasAxes::Axis none = axis({0.0});
  const AtlasAxes::Axis grips = axis({0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0});
  AtlasAxes stop{axis({0.0, 0.5}), axis({0.15}), none, {}};
  for (std::size_t i = manoeuvre::braking_strengths.size(); i-- > 0;) {
    stop.shares.push_back(manoeuvre::braking_strengths[i]);
  }
  stop.shares.push_back(1.0);
  add_range(stop.speeds, 1.0, 26.0, 1.0);
  add_range(stop.speeds, 28.0, 46.0, 2.0);
  for (const double grip : grips) {
    stop.grips.push_back(grip);
  }
  stop.grips.push_back(1.2);
  AtlasAxes keep{axis({0.0, 1.0, 2.5}), axis({0.15, 1.2}), none, none};
  add_range(keep.speeds, 5.0, 45.0, 5.0);
  keep.speeds.push_back(46.0);
  // Slow lane changes are bounded by direction, so that their time goes with 1 / speed.
  AtlasAxes swerve{{}, grips, axis({1.0, 2.0, 2.75, 3.5, 4.5, 7.0}), none};
  add_range(swerve.speeds, 5.0, 8.0, 0.5);
  add_range(swerve.speeds, 9.0, 25.0, 1.0);
  // Beyond a quarter and three quarters: a target that was set a while ago is another share by now.
  AtlasAxes braked{
      {}, grips, swerve.ways, axis({0.2, 0.25, 0.3125, 0.375, 0.5, 0.625, 0.75, 0.85})};
  add_range(braked.speeds, 5.0, 8.0, 0.5);
  add_range(braked.speeds, 9.0, 13.0, 1.0);
  add_range(braked.speeds, 14.0, 20.0, 2.0);
  add_range(braked.speeds, 22.5, 25.0, 2.5);
  AtlasAxes drift{{}, grips, none, none};
  add_range(drift.speeds, 4.0, 25.0, 1.0);
  return {stop, keep, swerve, braked, swerve, drift};
}

AtlasKind atlas_kind(const manoeuvre::Plan& plan) noexcept {
  switch (plan.policy) {
    case manoeuvre::PolicyId::aeb:
      return AtlasKind::stop;
    case manoeuvre::PolicyId::aes_left:
    case manoeuvre::PolicyId::aes_right:
      return AtlasKind::swerve;
    case manoeuvre::PolicyId::es_b_left:
    case manoeuvre::PolicyId::es_b_right:
      return plan.target_speed.value_or(0.0) < least_kept ? AtlasKind::swerve_stop
                                                          : AtlasKind::braked_swerve;
    case manoeuvre::PolicyId::t_drift_left:
    case manoeuvre::PolicyId::t_drift_right:
      return AtlasKind::drift;
    case manoeuvre::PolicyId::no_intervention:
      break;
  }
  return AtlasKind::keep;
}

AtlasInstant at(const AtlasPath& path, double time) noexcept {
  if (time <= path.end || (!path.rests && !path.ended)) {
    return within(path, time);
  }
  AtlasInstant last = within(path, path.end);
  const double inside = 1.0 - path.curvature * (path.start_d + last.y);
  const double speed = path.rests ? 0.0 : std::hypot(inside * last.x_rate, last.y_rate) / inside;
  last.x += speed * (time - path.end);
  last.x_rate = speed;
  last.y_rate = 0.0;
  last.turn_rate = 0.0;
  return last;
}

double sensitivity_share(double grip_factor) noexcept {
  constexpr double least_factor = 0.1;
  constexpr double of_less = 1.0 / (1.0 - sensitivity_grip_step) - 1.0;
  constexpr double of_more = 1.0 - 1.0 / (1.0 + sensitivity_grip_step);
  const double shorter = 1.0 - 1.0 / std::max(grip_factor, least_factor);
  return shorter / (shorter < 0.0 ? of_less : of_more);
}

FrictionSensitivity friction_sensitivity_at(const AtlasPath& path, double time,
                                            double grip_factor) noexcept {
  if (!(path.sensitivity_span > 0.0)) {
    return {};
  }
  const double last = static_cast<double>(sensitivity_samples - 1);
  const double place = std::clamp(time / path.sensitivity_span * last, 0.0, last);
  const std::size_t i = std::min(static_cast<std::size_t>(place), sensitivity_samples - 2);
  const double u = place - static_cast<double>(i);
  const double off = sensitivity_share(grip_factor);
  const std::size_t first = off < 0.0 ? 0 : 3;
  const auto value = [&](std::size_t c) {
    const auto& sensitivity = path.sensitivity[first + c];
    return std::abs(off) * ((1.0 - u) * static_cast<double>(sensitivity[i]) +
                            u * static_cast<double>(sensitivity[i + 1]));
  };
  return {value(0), value(1), value(2)};
}

Atlas::Atlas(const AtlasGrid& grid, const manoeuvre::DriftDomain& domain,
             std::span<const AtlasNode> nodes, std::shared_ptr<const void> keeper)
    : grid_(grid), domain_(domain), nodes_(nodes), keeper_(std::move(keeper)) {
  std::size_t first = 0;
  for (std::size_t kind = 0; kind < num_atlas_kinds; ++kind) {
    const AtlasAxes& axes = grid_[kind];
    for (const AtlasAxes::Axis* one : {&axes.speeds, &axes.grips, &axes.ways, &axes.shares}) {
      expects(!one->empty(), "every axis has a value");
      expects(std::adjacent_find(one->begin(), one->end(), std::greater_equal<>()) == one->end(),
              "axes rise");
    }
    first_[kind] = first;
    first += axes.num_nodes();
  }
  expects(nodes_.size() == first, "one node for each point of the grid");
}

Atlas::Atlas(const AtlasGrid& grid, const manoeuvre::DriftDomain& domain,
             const std::shared_ptr<const std::vector<AtlasNode>>& nodes)
    : Atlas(grid, domain, std::span<const AtlasNode>(*nodes), nodes) {}

std::span<const AtlasNode> Atlas::nodes(AtlasKind kind) const noexcept {
  const auto k = static_cast<std::size_t>(kind);
  return nodes_.subspan(first_[k], grid_[k].num_nodes());
}

std::optional<AtlasLimit> Atlas::outside(const manoeuvre::Plan& plan, const world::Scene& scene,
                                         const AtlasBounds& bounds) const noexcept {
  if (manoeuvre::index(plan.policy) >= manoeuvre::num_policies || !is_finite(scene)) {
    return AtlasLimit::no_number;
  }
  if (manoeuvre::brakes_to_speed(plan.policy) != plan.target_speed.has_value()) {
    return AtlasLimit::target_speed;
  }
  if (plan.strength && !manoeuvre::takes_strength(plan.policy)) {
    return AtlasLimit::strength;
  }
  const AtlasKind kind = atlas_kind(plan);
  const AtlasAxes& axes = grid_[static_cast<std::size_t>(kind)];
  const double speed = scene.ego.v_B.x;
  if (!holds(axes.grips, scene.grip) || !(scene.grip > 0.0)) {
    return AtlasLimit::grip;
  }
  if (!holds(axes.speeds, speed)) {
    return AtlasLimit::speed;
  }
  if (manoeuvre::drifts(plan.policy)) {
    const manoeuvre::SpeedRange range = manoeuvre::drift_speeds(domain_, scene.grip);
    if (!(speed >= range.slowest && speed <= range.fastest)) {
      return AtlasLimit::speed;
    }
  }
  if (plan.policy != manoeuvre::PolicyId::aeb &&
      plan.policy != manoeuvre::PolicyId::no_intervention &&
      !(scene.road.lane_width >= 2.0 && scene.road.lane_width <= 6.0)) {
    return AtlasLimit::lane_width;
  }
  if (manoeuvre::changes_lane(plan.policy) && !holds(axes.ways, way_to_go(plan, scene))) {
    return AtlasLimit::lane_width;
  }
  if (kind == AtlasKind::braked_swerve && !holds(axes.shares, *plan.target_speed / speed)) {
    return AtlasLimit::target_speed;
  }
  if (kind == AtlasKind::stop && !spans(axes.shares, manoeuvre::strength_of(plan))) {
    return AtlasLimit::strength;
  }
  if (kind == AtlasKind::swerve_stop && !(*plan.target_speed >= 0.0)) {
    return AtlasLimit::target_speed;
  }
  return off_straight(plan, scene, bounds);
}

AtlasPath Atlas::path(const manoeuvre::Plan& plan, const world::Scene& scene) const noexcept {
  const AtlasKind kind = atlas_kind(plan);
  const AtlasAxes& axes = grid_[static_cast<std::size_t>(kind)];
  const AtlasNode* const first = nodes_.data() + first_[static_cast<std::size_t>(kind)];
  const double speed = scene.ego.v_B.x;
  const Cell by_speed = cell_of(axes.speeds, speed);
  // Times and ways go with 1 / grip.
  const Cell by_grip = cell_of(axes.grips, scene.grip, true);
  const Cell by_way = cell_of(axes.ways, axes.ways.size() > 1 ? way_to_go(plan, scene) : 0.0);
  // A stop's times and ways go with 1 / strength too.
  const Cell by_share = cell_of(axes.shares, share_of(plan, kind, speed), kind == AtlasKind::stop);
  AtlasPath path;
  path.rests = ends_at_rest(kind);
  path.ended = true;
  const int mirror = manoeuvre::side(plan.policy) < 0 ? -1 : 1;
  for (unsigned corner = 0; corner < 16; ++corner) {
    double weight = 1.0;
    const auto chosen = [&](const Cell& cell, unsigned bit) {
      const bool high = (corner & bit) != 0;
      weight *= high ? cell.share : 1.0 - cell.share;
      return high ? cell.high : cell.low;
    };
    const std::size_t i = chosen(by_speed, 8);
    const std::size_t j = chosen(by_grip, 4);
    const std::size_t k = chosen(by_way, 2);
    const std::size_t l = chosen(by_share, 1);
    if (weight > 0.0) {
      const std::size_t node =
          ((i * axes.grips.size() + j) * axes.ways.size() + k) * axes.shares.size() + l;
      add_node(first[node], weight, mirror, scene.grip_sd > 0.0, path);
    }
  }
  path.curvature = scene.road.curvature;
  path.start_d = to_lane(scene.road, scene.ego.X_WB).d;
  if (path.curvature != 0.0) {
    bend(path);
  }
  return path;
}

}  // namespace saca::atlas
