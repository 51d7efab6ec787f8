#include "saca/lab/intention_scoring/simulated.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "saca/base/core/angle.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/pose.h"
#include "saca/base/world/road.h"
#include "saca/base/world/scene.h"
#include "saca/lab/intention_scoring/labels.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/sim/perception.h"

namespace saca::intention_scoring {
namespace {

using world::Actor;

static_assert(DriveMotion::step == sim::Perception::step);
constexpr std::size_t samples_per_frame = 10;
constexpr std::size_t samples_of_difference = 50;  // 0.5 s, as of the accelerations in a true scene
constexpr std::size_t samples_of_foresight = 15;   // from a pedal to what it does: an assumption

// A usual car. Only its length matters.
constexpr world::Footprint body{world::Shape::box, 4.5, 1.8};
constexpr double usual_mass = 1500.0;  // [kg]
constexpr double wheelbase = 2.7;      // [m]

/// Body and velocity of the vehicle and of the one ahead of it.
struct Moving {
  Pose X_WA;
  Vec2 v_W;
};

struct Truth {
  world::Road road;
  std::vector<Moving> own;                  ///< per sample
  std::vector<std::optional<Moving>> lead;  ///< likewise
  std::vector<std::uint8_t> lead_id;        ///< another in another lane
};

Moving moving(const world::Road& road, double s, double d, double slope, double speed) {
  const Pose X_WA = from_lane(road, {s, d, std::atan(slope)});
  return {X_WA, rotated(Vec2{speed * std::hypot(1.0, slope), 0.0}, X_WA.yaw)};
}

Truth truth_of(const DrivePlan& plan, const DriveMotion& motion) {
  Truth truth;
  truth.road.curvature = plan.curvature;
  truth.road.lane_width = plan.lane_width;
  truth.road.left_edge = 1.5 * plan.lane_width;
  truth.road.right_edge = -1.5 * plan.lane_width;
  double s = motion.way.front();
  for (std::size_t i = 0; i < motion.way.size(); ++i) {
    const double d = motion.aside[i];
    if (i > 0) {  // the same way sweeps more of the centre line on the inside of a curve
      s += (motion.way[i] - motion.way[i - 1]) / (1.0 - plan.curvature * d);
    }
    truth.own.push_back(moving(truth.road, s, d, motion.slope[i], motion.speed[i]));
    const double lane = std::round(d / plan.lane_width);
    truth.lead_id.push_back(lane == 0.0 ? 2 : 3);
    truth.lead.push_back(
        std::isfinite(motion.gap[i])
            ? std::optional(moving(truth.road, s + motion.gap[i] + body.length,
                                   lane * plan.lane_width, 0.0, motion.lead_speed[i]))
            : std::nullopt);
  }
  return truth;
}

Actor actor(std::uint8_t id, const Moving& now) {
  return {.id = id, .footprint = body, .mass = usual_mass, .X_WA = now.X_WA, .v_W = now.v_W};
}

/// With accelerations as a true scene has them.
Actor own_actor(const Truth& truth, std::size_t i) {
  Actor own = actor(1, truth.own[i]);
  const std::size_t steps = std::min(i, samples_of_difference);
  if (steps > 0) {
    const Moving& then = truth.own[i - steps];
    const double over = static_cast<double>(steps) * DriveMotion::step;
    own.a_W = (1.0 / over) * (own.v_W - then.v_W);
    own.yaw_rate = wrap_angle(own.X_WA.yaw - then.X_WA.yaw) / over;
  }
  return own;
}

world::Scene scene_of(const Truth& truth, std::size_t i) {
  world::Scene scene;
  scene.time = static_cast<double>(i) * DriveMotion::step;
  scene.ego.X_WB = {{-100.0, 0.0}, 0.0};  // stands by: who looks does not matter here
  scene.ego_footprint = body;
  scene.ego_mass = usual_mass;
  scene.road = truth.road;
  scene.actors.push_back(own_actor(truth, i));
  if (truth.lead[i]) {
    scene.actors.push_back(actor(truth.lead_id[i], *truth.lead[i]));
  }
  return scene;
}

const Actor* seen(const world::Scene& scene, std::uint8_t id) {
  const auto* const found = std::find_if(scene.actors.begin(), scene.actors.end(),
                                         [&](const Actor& other) { return other.id == id; });
  return found == scene.actors.end() ? nullptr : &*found;
}

Vec2 along_lane(const world::Road& road, const world::LanePose& place, Vec2 v_W) {
  return rotated(v_W, -(road.X_WL.yaw + road.curvature * place.s));
}

intent::Observation observation_of(const world::Scene& scene, const Actor& own, const Actor* lead) {
  const world::Road& road = scene.road;
  const world::LanePose place = to_lane(road, own.X_WA);
  const Vec2 v_L = along_lane(road, place, own.v_W);
  const double speed = norm(own.v_W);
  constexpr double crawl = 0.5;  // [m/s]: slower, noise decides where the velocity points
  const Vec2 forward =
      speed > crawl ? (1.0 / speed) * own.v_W : rotated(Vec2{1.0, 0.0}, own.X_WA.yaw);
  intent::Observation seen_now{
      .speed = speed,
      .acceleration = dot(own.a_W, forward),
      .yaw_rate = own.yaw_rate,
      .offset = place.d - std::round(place.d / road.lane_width) * road.lane_width,
      .lateral_speed = v_L.y,
      .heading = place.heading,
      .lane_width = road.lane_width,
      .gap = std::numeric_limits<double>::infinity()};
  if (lead != nullptr) {
    const world::LanePose ahead = to_lane(road, lead->X_WA);
    seen_now.gap = std::max(0.0, ahead.s - place.s - body.length);
    seen_now.gap_speed = along_lane(road, ahead, lead->v_W).x - v_L.x;
  }
  return seen_now;
}

/// What the driver does, which the motion follows. How much pedal makes how much acceleration is an
/// assumption: 9 m/s^2 at most, 3.5 m/s^2 from the motor, resistance of a usual car.
void share_pedals(const DriveMotion& motion, const Truth& truth, std::size_t i,
                  intent::Observation& seen_now) {
  const std::size_t caused = std::min(i + samples_of_foresight, motion.speed.size() - 1);
  const double speed = motion.speed[caused];
  const double turned =
      wrap_angle(truth.own[caused].X_WA.yaw - truth.own[caused - 1].X_WA.yaw) / DriveMotion::step;
  seen_now.steering = std::atan(wheelbase * turned / std::max(1.0, speed));
  const double resistance = speed > 0.0 ? 0.15 + 3e-4 * speed * speed : 0.0;
  const double driven = motion.acceleration[caused] + resistance;
  seen_now.throttle = std::clamp(driven / 3.5, 0.0, 1.0);
  seen_now.brake = std::clamp(-driven / 9.0, 0.0, 1.0);
}

/// Where the lane that holds the centre changes.
std::vector<double> crossings(const DrivePlan& plan, const DriveMotion& motion) {
  std::vector<double> times;
  for (std::size_t i = DriveMotion::before + 1; i < motion.aside.size(); ++i) {
    const double lane = std::round(motion.aside[i] / plan.lane_width);
    if (lane != std::round(motion.aside[i - 1] / plan.lane_width)) {
      times.push_back(static_cast<double>(i - DriveMotion::before) * DriveMotion::step);
    }
  }
  return times;
}

void add_labels(const DrivePlan& plan, const DriveMotion& motion, Sequence& sequence) {
  TrueMotion truth;
  truth.lane_width = plan.lane_width;
  for (std::size_t i = DriveMotion::before; i < motion.speed.size(); i += samples_per_frame) {
    truth.acceleration.push_back(motion.acceleration[i]);
    truth.lateral.push_back(motion.aside[i]);
    truth.lateral_speed.push_back(motion.slope[i] * motion.speed[i]);
  }
  Labels labels = labels_of(truth);
  sequence.labels = std::move(labels.classes);
  sequence.scored = std::move(labels.scored);
  sequence.braking_times = std::move(labels.braking_times);
  sequence.crossing_times = crossings(plan, motion);
}

}  // namespace

Sequence simulated_sequence(const DrivePlan& plan, std::uint64_t seed, const std::string& name) {
  const DriveMotion motion = drive(plan);
  const Truth truth = truth_of(plan, motion);
  Sequence sequence{.name = name, .site = "simulated", .group = name, .simulated = true};
  sim::Perception perception(plan.perception, seed);
  for (std::size_t i = samples_of_difference; i < motion.way.size(); ++i) {
    const world::Scene scene = perception.look(scene_of(truth, i));
    if (i < DriveMotion::before || (i - DriveMotion::before) % samples_per_frame != 0) {
      continue;
    }
    const Actor* const own = seen(scene, 1);
    expects(own != nullptr, "a perception that loses nobody");
    const Actor* const lead = truth.lead[i] ? seen(scene, truth.lead_id[i]) : nullptr;
    sequence.observations.push_back(observation_of(scene, *own, lead));
    if (plan.shares_pedals) {
      share_pedals(motion, truth, i, sequence.observations.back());
    }
  }
  add_labels(plan, motion, sequence);
  return sequence;
}

std::vector<Sequence> simulated_sequences(std::size_t count, std::uint64_t seed, int threads) {
  expects(threads >= 1, "threads >= 1");
  std::vector<Sequence> all(count);
  in_parallel(count, threads, [&](std::size_t i) {
    std::mt19937_64 rng = scenario::generator(seed, i);
    const DrivePlan plan = draw_plan(rng);
    all[i] = simulated_sequence(plan, rng(), fmt::format("simulated/{}/{:06}", seed, i));
  });
  return all;
}

}  // namespace saca::intention_scoring
