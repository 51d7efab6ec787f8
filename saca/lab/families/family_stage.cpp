#include "saca/lab/families/family_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/world/usual_body.h"
#include "saca/onboard/drivers/driver.h"

namespace saca::families {
namespace {

using world::ActorKind;
using world::Beyond;

constexpr double free_road = 1e3;  // [m]

Beyond draw_beyond(Dice& dice) {
  const double barrier = dice.in("barrier_share");
  const double trees = barrier + dice.in("trees_share");
  const double kerb = trees + dice.in("kerb_share");
  const double u = dice.even();
  return u < barrier ? Beyond::barrier
         : u < trees ? Beyond::trees
         : u < kerb  ? Beyond::kerb
                     : Beyond::unmarked;
}

}  // namespace

scenario::Script reacting(world::LanePose start, double speed, double gap, double reaction) {
  scenario::Script script{.start = start, .speed = speed, .behaviour = scenario::Behaviour::follow};
  script.law = drivers::content_with(drivers::usual_driver(speed), speed, gap);
  script.law.reaction = reaction;
  return script;
}

scenario::Script changing_lane(world::LanePose start, double speed, double to_d, double begins,
                               double takes) {
  return {.start = start,
          .speed = speed,
          .behaviour = scenario::Behaviour::lane_change,
          .from = begins,
          .to_d = to_d,
          .takes = takes};
}

scenario::Script stopping_after(scenario::Script script, double room) {
  constexpr double hard = 7.0;
  const double way = 0.5 * script.speed * script.speed / hard;
  script.behaviour = scenario::Behaviour::brake;
  script.acceleration = way < room ? hard : 0.5 * script.speed * script.speed / room;
  script.from = std::max(0.0, (room - way) / script.speed);
  return script;
}

bool Dice::has(std::string_view key) const {
  return family_.ranges.find(key) != family_.ranges.end();
}

double Dice::in(std::string_view key) {
  const auto range = family_.ranges.find(key);
  expects(range != family_.ranges.end(), "the family has a range for the key");
  const auto& [min, max, source] = range->second;
  return min + (max - min) * even();
}

Stage::Stage(Dice& the_dice, const world::Footprint& ego, bool junction) : dice(the_dice) {
  world::Road& road = scenario.road;
  road.topology = junction ? world::Topology::intersection : world::Topology::straight;
  scenario.grip = dice.in("grip");
  road.lane_width = dice.in("lane_width_m");
  const bool left = dice.happens("left_lane_share");
  const bool right = dice.happens("right_lane_share");
  left_lane = left;
  right_lane = right;
  road.oncoming_left = dice.happens("oncoming_share") && left;
  road.left_edge = road.lane_width * (left ? 1.5 : 0.5) + dice.in("shoulder_m") + 0.01;
  road.right_edge = -road.lane_width * (right ? 1.5 : 0.5) - dice.in("shoulder_m") - 0.01;
  road.left_beyond = draw_beyond(dice);
  road.right_beyond = draw_beyond(dice);
  speed = dice.in("ego_speed_mps");
  front = ego.centre_x + 0.5 * ego.length;
  rear = 0.5 * ego.length - ego.centre_x;
  width = ego.width;
  scenario.ego = scenario::EgoStart{{}, speed};
  scenario.duration = approach + 8.0;
  decision = approach;
}

double Stage::length_of(ActorKind kind) {
  return world::usual_body(kind).footprint.length;
}
double Stage::width_of(ActorKind kind) {
  return world::usual_body(kind).footprint.width;
}

ActorKind Stage::any_vehicle() {
  const double van = dice.in("van_share");
  const double truck = van + dice.in("truck_share");
  const double motorcycle =
      dice.has("motorcycle_share") ? truck + dice.in("motorcycle_share") : truck;
  const double u = dice.even();
  return u < van          ? ActorKind::van
         : u < truck      ? ActorKind::truck
         : u < motorcycle ? ActorKind::motorcycle
                          : ActorKind::car;
}

void Stage::widen(double side, double room) {
  double& edge = side > 0.0 ? scenario.road.left_edge : scenario.road.right_edge;
  edge = side * std::max(std::abs(edge), room + 0.01);
}

void Stage::want_lane(double side) {
  widen(side, 1.5 * lane());
  (side > 0.0 ? left_lane : right_lane) = true;
  if (side > 0.0) {
    scenario.road.oncoming_left = false;
  }
}

scenario::ScenarioActor& Stage::add(ActorKind kind, scenario::Script script) {
  std::uint8_t id = 1;
  for (const scenario::ScenarioActor& other : scenario.actors) {
    id = static_cast<std::uint8_t>(id + (other.kind == kind ? 1 : 0));
  }
  const world::UsualBody body = world::usual_body(kind);
  scenario.actors.push_back(
      {.id = id, .kind = kind, .footprint = body.footprint, .mass = body.mass, .motion = script});
  return scenario.actors.back();
}

void Stage::add_surroundings() {
  add_follower();
  if (left_lane && dice.happens("left_busy_share")) {
    add_neighbour(1.0);
  }
  if (right_lane && dice.happens("right_busy_share")) {
    add_neighbour(-1.0);
  }
}

void Stage::add_follower() {
  const bool there = dice.happens("follower_share");
  const double gap = speed * dice.in("follower_gap_s");
  const double reaction = dice.in("follower_reaction_s");
  if (!there) {
    return;
  }
  const double length = length_of(ActorKind::car);
  add(ActorKind::car, reacting({.s = -rear - gap - 0.5 * length}, speed, gap, reaction));
}

void Stage::add_neighbour(double side) {
  const double gap = dice.in("neighbour_gap_m");
  const double share = dice.in("neighbour_speed_share");
  const double ahead = dice.in("oncoming_ahead_m");
  const double reaction = dice.in("follower_reaction_s");
  const double there = speed * decision;  // the ego, when it must act
  const double pace = share * speed;
  if (side > 0.0 && scenario.road.oncoming_left) {
    const double s = there + front + ahead + 0.5 * length_of(ActorKind::car) + pace * decision;
    add(ActorKind::car, {.start = {s, lane(), std::numbers::pi}, .speed = pace});
  } else {
    scenario::Script script = reacting({.s = there + gap - pace * decision, .d = side * lane()},
                                       pace, free_road, reaction);
    script.law.desired_speed = pace;
    add(ActorKind::car, script);
  }
}

}  // namespace saca::families
