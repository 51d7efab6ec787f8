#include "saca/lab/eval/rss.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saca/onboard/vehicle/vehicle.h"

namespace saca::eval {
namespace {

using encounter::Action;
using manoeuvre::PolicyId;

/// Way of one who accelerates while it responds and brakes then to rest.
double way_to_rest(double speed, double acceleration, double braking, double response_time) {
  const double then = speed + acceleration * response_time;
  return 0.5 * (speed + then) * response_time + then * then / (2.0 * braking);
}

/// The worst of those ahead who are dangerously near: the nearest.
std::optional<LaneView> nearest_danger(const world::Scene& scene, const RssParameters& parameters) {
  std::optional<LaneView> nearest;
  for (const world::Actor& actor : scene.actors) {
    const LaneView view = lane_view(scene, actor);
    if (view.ahead && rss_dangerous(view, parameters) && (!nearest || view.gap < nearest->gap)) {
      nearest = view;
    }
  }
  return nearest;
}

/// All that the road's grip gives does not stop the ego before it meets the other, who comes nearer
/// all the while where it is oncoming.
bool brakes_too_late(const LaneView& view, double grip) {
  const double braking = grip * vehicle::gravity;
  const double closing = view.ego_speed - std::max(0.0, view.speed);
  const double oncoming = std::max(0.0, -view.speed) * view.ego_speed / braking;
  return closing > 0.0 && closing * closing / (2.0 * braking) + oncoming > view.gap;
}

/// Is there a lane of the ego's own direction on this side, in which the distances to all are kept?
bool has_free_lane(const world::Scene& scene, bool left, const RssParameters& parameters) {
  const world::Road& road = scene.road;
  const double side = left ? 1.0 : -1.0;
  const double beyond = side * (left ? road.left_edge : road.right_edge);
  if ((left ? road.oncoming_left : road.oncoming_right) ||
      beyond < road.lane_width + 0.5 * scene.ego_footprint.width) {
    return false;
  }
  world::Scene there = scene;  // as if the ego were in that lane already
  there.ego.X_WB = scene.ego.X_WB * Pose{{0.0, side * road.lane_width}, 0.0};
  return std::none_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
    const LaneView view = lane_view(there, actor);
    if (view.side_gap > parameters.side_margin) {
      return false;
    }
    const double wanted = view.ahead
                              ? rss_following_distance(std::max(0.0, view.ego_speed),
                                                       std::max(0.0, view.speed), parameters)
                              : rss_following_distance(std::max(0.0, view.speed),
                                                       std::max(0.0, view.ego_speed), parameters);
    return view.gap < wanted;
  });
}

}  // namespace

double rss_following_distance(double rear, double front, const RssParameters& parameters) {
  return std::max(0.0, way_to_rest(rear, parameters.acceleration, parameters.braking,
                                   parameters.response_time) -
                           front * front / (2.0 * parameters.braking));
}

double rss_oncoming_distance(double speed, double oncoming, const RssParameters& parameters) {
  const auto way = [&](double v) {
    return way_to_rest(v, parameters.acceleration, parameters.braking, parameters.response_time);
  };
  return way(speed) + way(oncoming);
}

double rss_side_distance(double towards, double other, const RssParameters& parameters) {
  const auto way = [&](double v) {
    const double a = parameters.side_acceleration;
    const double time = parameters.response_time;
    const double then = v + a * time;
    // Who moves away all the while is braked by nothing.
    return 0.5 * (v + then) * time + std::copysign(then * then, then) / (2.0 * a);
  };
  return parameters.side_margin + std::max(0.0, way(towards) + way(other));
}

bool rss_dangerous(const LaneView& view, const RssParameters& parameters) {
  if (view.side_gap >= rss_side_distance(view.ego_aside, view.closing_aside, parameters)) {
    return false;
  }
  const double ego = std::max(0.0, view.ego_speed);
  const double wanted = view.speed < 0.0 ? rss_oncoming_distance(ego, -view.speed, parameters)
                                         : rss_following_distance(ego, view.speed, parameters);
  return view.gap < wanted;
}

std::optional<Action> Rss::step(const encounter::View& view) {
  const world::Scene& scene = view.scene;
  const auto danger = nearest_danger(scene, parameters_);
  if (steers_ || (!danger && !brakes_)) {
    return std::nullopt;
  }
  if (!danger) {
    brakes_ = false;
    return Action{.plan = {PolicyId::no_intervention, std::nullopt},
                  .source = "rss",
                  .reason = "the distances are kept again"};
  }
  if (response_ == Response::braking_or_steering && brakes_too_late(*danger, scene.grip)) {
    for (const bool left : {!danger->left, danger->left}) {
      if (has_free_lane(scene, left, parameters_)) {
        steers_ = true;
        return Action{.plan = {left ? PolicyId::aes_left : PolicyId::aes_right, std::nullopt},
                      .source = "rss",
                      .reason = "braking comes too late, the neighbouring lane is free"};
      }
    }
  }
  if (std::exchange(brakes_, true)) {
    return std::nullopt;
  }
  return Action{.plan = {PolicyId::aeb, std::nullopt},
                .deceleration = parameters_.response_braking,
                .source = "rss",
                .reason = "a distance is not kept"};
}

}  // namespace saca::eval
