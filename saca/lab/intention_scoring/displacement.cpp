#include "saca/lab/intention_scoring/displacement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "saca/base/core/contract.h"
#include "saca/base/world/scene.h"

namespace saca::intention_scoring {
namespace {

using intent::Intention;
using intent::Observation;

constexpr std::size_t frames_per_second = 10;
constexpr std::size_t horizon = 3 * frames_per_second;
constexpr std::size_t stride = frames_per_second / 2;
constexpr double num_lanes_beside = 3.0;  // to both sides: nobody leaves the road in 3 s

/// Places along and across the lane, frame by frame; NaN where the lane is not known.
std::vector<Vec2> places(const Sequence& sequence) {
  std::vector<Vec2> all;
  Vec2 at;
  const Observation* last = nullptr;
  for (const Observation& now : sequence.observations) {
    if (last != nullptr) {
      at.x += 0.5 * (last->speed + now.speed) * frame_step;
      at.y = std::isnan(last->offset) ? now.offset : at.y + intent::moved_aside(*last, now);
    } else {
      at.y = now.offset;
    }
    all.push_back(at);
    last = &now;
  }
  return all;
}

/// The vehicle in a straight lane.
world::Scene scene_of(const Observation& seen) {
  world::Scene scene;
  scene.ego.X_WB.p = {-1'000.0, 0.0};
  scene.ego_footprint = {.length = 4.5, .width = 1.8};
  scene.ego_mass = 1'500.0;
  scene.road.lane_width = seen.lane_width;
  scene.road.left_edge = (num_lanes_beside + 0.5) * seen.lane_width;
  scene.road.right_edge = -scene.road.left_edge;
  world::Actor actor{.id = 1, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  const double aside = std::clamp(seen.lateral_speed, -0.5 * seen.speed, 0.5 * seen.speed);
  actor.v_W = {std::sqrt(seen.speed * seen.speed - aside * aside), aside};
  actor.X_WA = {{0.0, seen.offset}, seen.speed > 0.0 ? std::asin(aside / seen.speed) : 0.0};
  actor.a_W = seen.speed > 0.0 ? (seen.acceleration / seen.speed) * actor.v_W : Vec2{};
  scene.actors.push_back(actor);
  return scene;
}

/// Where the vehicle is said to be after each of `seconds_ahead`, from (0, offset).
using Places = std::array<Vec2, seconds_ahead.size()>;

Places under(const world::Scene& scene, Intention intention, const intent::MotionLaw& law) {
  const intent::Forecast forecast = intent::motion_under(
      scene, scene.actors[0], intention, static_cast<double>(seconds_ahead.back()), law);
  Places said;
  for (std::size_t k = 0; k < said.size(); ++k) {
    said[k] = world::pose_at(forecast.track, scene.time + static_cast<double>(seconds_ahead[k])).p;
  }
  return said;
}

std::array<Places, num_foresights> foreseen(const Observation& seen, const ClassProbabilities& now,
                                            const intent::MotionLaw& law) {
  const world::Scene scene = scene_of(seen);
  std::array<Places, num_foresights> said{};
  const Vec2 v_W = scene.actors[0].v_W;
  for (std::size_t k = 0; k < seconds_ahead.size(); ++k) {
    const auto time = static_cast<double>(seconds_ahead[k]);
    said[0][k] = {v_W.x * time, seen.offset + v_W.y * time};
    said[1][k] = {seen.speed * time, seen.offset};
  }
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    const Places one = under(scene, static_cast<Intention>(c), law);
    for (std::size_t k = 0; k < one.size(); ++k) {
      said[3][k] = said[3][k] + now[c] * one[k];
    }
    if (c == likeliest_class(now)) {
      said[2] = one;
    }
  }
  return said;
}

bool keeps_its_lane_known(const Sequence& sequence, std::size_t first) {
  return std::none_of(
      sequence.observations.begin() + static_cast<std::ptrdiff_t>(first),
      sequence.observations.begin() + static_cast<std::ptrdiff_t>(first + horizon + 1),
      [](const Observation& seen) { return std::isnan(seen.offset); });
}

}  // namespace

void Displacement::add(double distance) {
  ++num;
  sum += distance;
  squares += distance * distance;
}

Displacement& Displacement::operator+=(const Displacement& other) {
  num += other.num;
  sum += other.sum;
  squares += other.squares;
  return *this;
}

double Displacement::mean() const {
  return num == 0 ? 0.0 : sum / static_cast<double>(num);
}

double Displacement::rms() const {
  return num == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(num));
}

Displacements& Displacements::operator+=(const Displacements& other) {
  for (std::size_t f = 0; f < num_foresights; ++f) {
    for (std::size_t k = 0; k < seconds_ahead.size(); ++k) {
      all[f][k] += other.all[f][k];
      acting[f][k] += other.acting[f][k];
    }
  }
  return *this;
}

Displacements displacements(const Sequence& sequence, const Forecasts& forecasts,
                            const intent::MotionLaw& law) {
  expect_forecasts_of(sequence, forecasts);
  Displacements found;
  const std::vector<Vec2> truth = places(sequence);
  for (std::size_t t = 0; t + horizon < truth.size(); t += stride) {
    if (!keeps_its_lane_known(sequence, t)) {
      continue;
    }
    const Observation& seen = sequence.observations[t];
    const auto said = foreseen(seen, forecasts.at[0][t], law);
    const bool acts = sequence.scored[t] && sequence.labels[t] != 0;
    for (std::size_t k = 0; k < seconds_ahead.size(); ++k) {
      const Vec2 there = truth[t + seconds_ahead[k] * frames_per_second];
      const Vec2 moved{there.x - truth[t].x, there.y - truth[t].y + seen.offset};
      for (std::size_t f = 0; f < num_foresights; ++f) {
        const double distance = norm(said[f][k] - moved);
        found.all[f][k].add(distance);
        if (acts) {
          found.acting[f][k].add(distance);
        }
      }
    }
  }
  return found;
}

}  // namespace saca::intention_scoring
