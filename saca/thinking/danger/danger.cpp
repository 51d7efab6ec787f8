#include "saca/thinking/danger/danger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/thinking/danger/follow.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::danger {
namespace {

using world::Footprint;

constexpr double look_ahead = 16.0;  // [s]: longer than a stop from 45 m/s on grip 0.3 takes
constexpr double input_step = 0.1;   // [s], of inputs on the way to a table
constexpr int num_few = 16;          // of the constant accelerations, where there is no table

bool same(const Footprint& a, const Footprint& b) {
  return a.shape == b.shape && a.length == b.length && a.width == b.width;
}

/// Fully braked and straight on: what is done until a table begins.
constexpr Acceleration straight_on{};
constexpr Acceleration braked{-1e3, 0.0};  // `driven` takes it to the limits

/// By how much a body reaches beyond another about the same origin, at most: the first lies within
/// the second grown by that much on all sides.
double beyond(const Footprint& body, const Footprint& table) {
  const Vec2 half = world::half_axes(body);
  const Vec2 other = world::half_axes(table);
  const double front = body.centre_x + half.x - (table.centre_x + other.x);
  const double rear = table.centre_x - other.x - (body.centre_x - half.x);
  const double along = std::max({0.0, front, rear});
  const double across = std::max(0.0, half.y - other.y);
  const bool same_middle = body.centre_x == table.centre_x;
  if (table.shape == world::Shape::box || (body.shape == table.shape && same_middle)) {
    return std::hypot(along, across);
  }
  const double corner = std::hypot(half.x + std::abs(body.centre_x - table.centre_x), half.y);
  return std::max(0.0, corner - std::min(other.x, other.y));
}

Footprint centred(Footprint footprint) {
  footprint.centre_x = 0.0;
  return footprint;
}

double intrusion_of(const Meeting& meeting, const State& state) {
  const Pose X_OE{{state[0], state[1]}, state[2]};
  return intrusion(meeting.ego, X_OE, centred(meeting.obstacle), Pose{});
}

Avoidance system_of(const Avoidance& car, const Meeting& meeting) {
  Avoidance system = car;
  system.grip = std::min(meeting.grip, car.grip);  // a motor's share of more would be less
  system.obstacle_speed = meeting.obstacle_speed;
  return system;
}

/// Two tables around a speed, and the share of the second.
struct Around {
  const DangerTable* low;
  const DangerTable* high;
  double share;
};

std::optional<Around> around(const std::vector<DangerTable>& family, double speed) {
  constexpr double rounding = 1e-6;  // [m/s]
  if (speed > family.back().obstacle_speed + rounding ||
      speed < family.front().obstacle_speed - rounding) {
    return std::nullopt;
  }
  std::size_t i = 0;
  while (i + 2 < family.size() && family[i + 1].obstacle_speed <= speed) {
    ++i;
  }
  const DangerTable& low = family[i];
  const DangerTable& high = family[std::min(i + 1, family.size() - 1)];
  const double span = high.obstacle_speed - low.obstacle_speed;
  const double share = span > 0.0 ? (speed - low.obstacle_speed) / span : 0.0;
  return Around{&low, &high, std::clamp(share, 0.0, 1.0)};
}

// Two obstacles of different speeds are compared where they would be when it comes to the worst,
// not where they are now: most of the time until the ego, going straight on, is nearest (the rest
// of it the ego is already somewhere else). Found by trying shares of it: docs/decisions/0014.
constexpr double aligned_share = 0.7;

/// Along x, what an obstacle gains on one that is 1 m/s slower until then [m per m/s].
double time_to_align(const State& state, double obstacle_speed) {
  const Vec2 v_rel{state[3] * std::cos(state[2]) - obstacle_speed, state[3] * std::sin(state[2])};
  const double square = dot(v_rel, v_rel);
  const double nearing = -dot({state[0], state[1]}, v_rel);
  return square > 0.0 ? aligned_share * std::max(0.0, nearing / square) : 0.0;
}

/// Between two tables; what their values, brought together, still differ by is part of the error.
LookupResult looked(const Around& tables, const State& state, double obstacle_speed) {
  if (tables.share <= 0.0) {
    return tables.low->values->at(grid_state(tables.low->view, state));
  }
  const double time = time_to_align(state, obstacle_speed);
  const auto by = [&](const DangerTable& table) {
    State there = state;
    there[0] += (table.obstacle_speed - obstacle_speed) * time;
    return table.values->at(grid_state(table.view, there));
  };
  const LookupResult low = by(*tables.low);
  const LookupResult high = by(*tables.high);
  const double step = high.value - low.value;
  return {low.value + tables.share * step,
          std::max(low.error, high.error) + tables.share * (1.0 - tables.share) * std::abs(step),
          low.inside && high.inside};
}

/// What a family tells of one meeting at whatever state it comes to.
struct LookUp {
  Around tables;
  double speed_factor;    ///< to the tables' grip
  double obstacle_speed;  ///< there [m/s]
  double grown;           ///< by how much the bodies reach beyond the tables' [m]

  /// nullopt: beyond the tables' ends.
  [[nodiscard]] std::optional<double> at(State state) const {
    state[3] *= speed_factor;
    const LookupResult found = looked(tables, state, obstacle_speed);
    return found.inside ? std::optional(found.value + found.error + grown) : std::nullopt;
  }
};

/// nullopt: the obstacle is faster than any table's.
std::optional<LookUp> look_up(const std::vector<DangerTable>& family, const Avoidance& car,
                              const Footprint& ego, const Meeting& meeting) {
  const ScaledAvoidance scaled = scaled_to(system_of(car, meeting), car.grip);
  const double obstacle_speed = meeting.obstacle_speed * scaled.speed_factor;
  const auto tables = around(family, obstacle_speed);
  if (!tables) {
    return std::nullopt;
  }
  const double grown = beyond(centred(meeting.obstacle), centred(family.front().obstacle)) +
                       beyond(meeting.ego, ego);
  return LookUp{*tables, scaled.speed_factor, obstacle_speed, grown};
}

/// One step of an evasion, or all of it.
EvasionPath driven_by(const Avoidance& system, const Meeting& meeting, const State& state,
                      const Acceleration& input, double longest) {
  return follow(
      system, [&](const State& at) { return intrusion_of(meeting, at); },
      [&](const State&) { return input; }, state,
      {.reach = world::bounding_radius(meeting.ego), .step = input_step, .longest = longest});
}

/// The highest h on the way to where a table takes over, and what that tells.
double until_a_table(const LookUp& values, const Avoidance& system, const Meeting& meeting,
                     const Acceleration& input) {
  State state = meeting.state;
  double highest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k * input_step < look_ahead; ++k) {
    const EvasionPath way = driven_by(system, meeting, state, input, input_step);
    highest = std::max(highest, way.highest);
    if (way.is_settled) {
      break;
    }
    state = way.last;
    if (const auto there = values.at(state)) {
      return std::max(highest, *there);
    }
  }
  return highest;
}

void require(const Meeting& meeting) {
  expects(meeting.grip > 0.0 && meeting.grip <= 1.5, "0 < grip <= 1.5");
  expects(meeting.obstacle_speed >= 0.0 && std::isfinite(meeting.obstacle_speed),
          "obstacle_speed >= 0");
  expects(std::all_of(meeting.state.begin(), meeting.state.end(),
                      [](double x) { return std::isfinite(x); }) &&
              meeting.state[3] >= 0.0,
          "a finite state, speed >= 0");
}

}  // namespace

double misfit(const Footprint& a, const Footprint& b) {
  return beyond(centred(a), centred(b)) + beyond(centred(b), centred(a));
}

DangerModel::DangerModel(const Avoidance& car, const Footprint& ego,
                         std::vector<DangerTable> tables, LearnedValue learned)
    : car_(car), ego_(ego), learned_(std::move(learned)) {
  static_cast<void>(limits_at(car, 0.0));  // the car's numbers are in range
  for (DangerTable& table : tables) {
    expects(table.values != nullptr && table.values->grid().axes.size() == 4,
            "tables have four axes");
    expects(table.view != View::edge, "tables are of an obstacle");
    expects(table.obstacle_speed >= 0.0, "obstacle_speed >= 0");
    const auto family = std::find_if(families_.begin(), families_.end(), [&](const Family& f) {
      return same(f.front().obstacle, table.obstacle);
    });
    Family& to = family == families_.end() ? families_.emplace_back() : *family;
    to.push_back(std::move(table));
  }
  for (Family& family : families_) {
    std::sort(family.begin(), family.end(), [](const DangerTable& a, const DangerTable& b) {
      return a.obstacle_speed < b.obstacle_speed;
    });
  }
}

const DangerModel::Family* DangerModel::family_for(const Footprint& obstacle) const {
  const Family* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Family& family : families_) {
    // What the table's body lacks is added to the value in full; what it has too much is in it.
    const double off = misfit(obstacle, family.front().obstacle);
    if (off < least) {
      least = off;
      best = &family;
    }
  }
  return best;
}

double DangerModel::by_few_evasions(const Meeting& meeting) const {
  const Avoidance system = system_of(car_, meeting);
  const double disc = limits_at(system, meeting.state[3]).disc;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -1; i < num_few; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / num_few;
    const Acceleration input =
        i < 0 ? straight_on : Acceleration{disc * std::cos(angle), disc * std::sin(angle)};
    least = std::min(least, driven_by(system, meeting, meeting.state, input, look_ahead).highest);
  }
  return least;
}

Danger DangerModel::danger(const Meeting& meeting, const Motion& motion) const {
  require(meeting);
  const Family* const family = family_for(meeting.obstacle);
  const auto values = family != nullptr ? look_up(*family, car_, ego_, meeting) : std::nullopt;
  if (const auto here = values ? values->at(meeting.state) : std::nullopt) {
    return {*here, true};
  }
  if (const auto known = learned_ ? learned_(meeting, motion) : std::nullopt) {
    return {*known, false};
  }
  double least = by_few_evasions(meeting);
  if (values) {
    const Avoidance system = system_of(car_, meeting);
    for (const Acceleration& input : {straight_on, braked}) {
      least = std::min(least, until_a_table(*values, system, meeting, input));
    }
  }
  return {least, false};
}

std::optional<double> DangerModel::known(const Meeting& meeting, const Motion& motion) const {
  const auto solved = exact(meeting);
  return solved || !learned_ ? solved : learned_(meeting, motion);
}

std::optional<double> DangerModel::exact(const Meeting& meeting) const {
  require(meeting);
  const Family* const family = family_for(meeting.obstacle);
  const auto values = family != nullptr ? look_up(*family, car_, ego_, meeting) : std::nullopt;
  return values ? values->at(meeting.state) : std::nullopt;
}

}  // namespace saca::danger
