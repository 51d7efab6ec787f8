// Longer than 400 lines: one function for each kind of family, which a reader compares.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/fnv.h"
#include "saca/base/core/units.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/family_cues.h"
#include "saca/lab/families/family_stage.h"
#include "saca/lab/families/family_vehicles.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/sim/traffic.h"

namespace saca::families {
namespace {

using world::ActorKind;

constexpr double right_angle = 0.5 * std::numbers::pi;
constexpr double trigger = Stage::trigger;

constexpr double notices = 0.3;  // [s] after the ego must act somebody on foot sees it: assumption

/// On a straight path across our lane: at `where` along the lane, in the middle of it at `time`.
scenario::Script crossing_at(double s, double d, double time, double heading, double speed) {
  const double way = speed * time;
  return {.start = {s - way * std::cos(heading), d - way * std::sin(heading), heading},
          .speed = speed};
}

/// How far from the middle of our lane cars are parked on a side: beside its outermost lane.
double parked_aside(const Stage& stage, double side) {
  const double lanes = (side > 0.0 ? stage.left_lane : stage.right_lane) ? 1.5 : 0.5;
  return lanes * stage.lane() + 0.6 + 0.5 * Stage::width_of(ActorKind::car);
}

/// Parked on that side; its front `ahead` of the place `s`.
void park(Stage& stage, double s, double ahead, double side) {
  const double length = Stage::length_of(ActorKind::car);
  const double d = parked_aside(stage, side);
  stage.add(ActorKind::car, {.start = {s + ahead - 0.5 * length, side * d, 0.0},
                             .behaviour = scenario::Behaviour::hold});
  stage.widen(side, d + Stage::width_of(ActorKind::car));
}

Harmless crossing(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double side = dice.side("from_left_share");
  const double angle = from_degrees(dice.in("angle_deg"));
  const double speed = dice.in("other_speed_mps");
  const double time = Stage::approach + dice.in("late_s");
  const double s = stage.head() + 0.5 * Stage::width_of(kind);
  const scenario::Script script = crossing_at(s, 0.0, time, -side * angle, speed);
  stage.add(kind, script);
  stage.decision = Stage::approach - trigger;
  if (dice.happens("bystander_share")) {
    // Between half a metre and a metre and a half beside our lane, to either side.
    const double aside = 0.5 * stage.lane() + 0.5 + dice.even();
    stage.add(ActorKind::pedestrian,
              {.start = {s + dice.in("bystander_ahead_m"), dice.even() < 0.5 ? -aside : aside,
                         -side * right_angle},
               .behaviour = scenario::Behaviour::hold});
  }
  if (stage.scenario.road.oncoming_left && dice.happens("waiting_share")) {
    const double front = s + 0.5 * Stage::width_of(kind) + dice.in("waiting_ahead_m");
    stage.add(ActorKind::car, {.start = {front + 0.5 * Stage::length_of(ActorKind::car),
                                         stage.lane(), std::numbers::pi},
                               .behaviour = scenario::Behaviour::hold});
  }
  // The twin stops a metre before our lane.
  const double room =
      speed * time - (0.5 * stage.lane() + 1.0) / std::sin(angle) - 0.5 * Stage::length_of(kind);
  return stopping_after(script, room);
}

Harmless one_way(Stage& stage) {
  Dice& dice = stage.dice;
  stage.scenario.road.topology = world::Topology::one_way;
  const double s = stage.head();
  scenario::ScenarioActor& first =
      stage.add(ActorKind::obstacle, {.behaviour = scenario::Behaviour::hold});
  first.footprint = {
      .shape = dice.happens("ellipse_share") ? world::Shape::ellipse : world::Shape::box,
      .length = dice.in("obstacle_length_m"),
      .width = dice.in("obstacle_width_m")};
  std::get<scenario::Script>(first.motion).start = {s + 0.5 * first.footprint.length,
                                                    dice.in("obstacle_offset_m"), 0.0};
  stage.decision = Stage::approach - trigger;
  if (dice.happens("second_share")) {
    const double size = dice.in("second_size_m");
    const scenario::Script place{.start = {s + dice.in("second_ahead_m") + 0.5 * size,
                                           -dice.in("second_aside_m") - 0.5 * size, 0.0},
                                 .behaviour = scenario::Behaviour::hold};
    stage.add(ActorKind::obstacle, place).footprint = {
        .shape = world::Shape::ellipse, .length = size, .width = size};
  }
  if (dice.happens("merging_share")) {
    stage.widen(-1.0, 2.5 * stage.lane());
    stage.right_lane = true;
    const double pace = stage.speed * dice.in("merging_speed_share");
    const double there = stage.speed * stage.decision + dice.in("merging_ahead_m");
    const world::LanePose start{there - pace * stage.decision, -2.0 * stage.lane(), 0.0};
    stage.add(ActorKind::van, changing_lane(start, pace, -stage.lane(), stage.decision,
                                            dice.in("merging_takes_s")));
  }
  return std::nullopt;
}

Harmless lead_brakes(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double gap = stage.speed * dice.in("gap_s");
  const double hard = std::min(dice.in("deceleration_mps2"), from_g(stage.scenario.grip));
  const scenario::Script going_on{
      .start = {stage.front + gap + 0.5 * Stage::length_of(kind), 0.0, 0.0}, .speed = stage.speed};
  scenario::Script brakes = going_on;
  brakes.behaviour = scenario::Behaviour::brake;
  brakes.acceleration = hard;
  brakes.from = Stage::approach;
  stage.add(kind, brakes);
  stage.decision = Stage::approach + std::max(0.0, std::sqrt(2.0 * gap / hard) - trigger);
  return going_on;
}

Harmless cut_in(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double side = dice.side("from_left_share");
  const double pace = std::max(1.0, stage.speed - dice.in("slower_mps"));
  const double gap = dice.in("gap_m");
  const double takes = dice.in("takes_s");
  stage.want_lane(side);
  const double begins = Stage::approach;
  const double s = stage.head() + gap + 0.5 * Stage::length_of(kind) - pace * begins;
  const world::LanePose start{s, side * stage.lane(), 0.0};
  scenario::Script script = changing_lane(start, pace, 0.0, begins, takes);
  const double hard = std::min(dice.in("deceleration_mps2"), from_g(stage.scenario.grip));
  if (dice.happens("brakes_share")) {
    script.acceleration = hard;
  }
  stage.add(kind, script);
  stage.decision = begins + 0.4 * takes;
  return scenario::Script{.start = start, .speed = pace};
}

Harmless cut_out(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double s = stage.head();
  const double length = Stage::length_of(ActorKind::car);
  stage.add(ActorKind::car, {.start = {s + 0.5 * length, dice.in("offset_m"), 0.0},
                             .behaviour = scenario::Behaviour::hold});
  const double gap = stage.speed * dice.in("gap_s");
  const double meets = Stage::approach - (gap + Stage::length_of(kind)) / stage.speed;
  const double side = dice.side("to_left_share");
  stage.want_lane(side);
  const world::LanePose start{stage.front + gap + 0.5 * Stage::length_of(kind), 0.0, 0.0};
  stage.add(kind,
            changing_lane(start, stage.speed, side * stage.lane(),
                          std::max(0.0, meets - dice.in("moves_out_at_s")), dice.in("takes_s")));
  stage.decision = Stage::approach - trigger;
  return std::nullopt;
}

/// Where across our lane somebody is when our front is there: `overlap` of our width, counted from
/// the side that he comes from.
double struck_at(const Stage& stage, double side, double overlap) {
  return side * stage.width * (0.5 - overlap);
}

Harmless pedestrian(Stage& stage) {
  Dice& dice = stage.dice;
  const double side = dice.side("from_left_share");
  const double pace = dice.in("walk_mps");
  const double s = stage.head() + 0.5 * Stage::width_of(ActorKind::pedestrian);
  const double d = struck_at(stage, side, dice.in("overlap"));
  scenario::Script script = crossing_at(s, d, Stage::approach, -side * right_angle, pace);
  stage.decision = Stage::approach - trigger;
  script.behaviour = scenario::Behaviour::walk;
  script.from = stage.decision + notices;
  script.run_speed = dice.in("run_mps");
  script.chance_stop = dice.in("chance_stop");
  script.chance_run = dice.in("chance_run");
  const double choice = dice.even();
  script.then = choice < *script.chance_stop                        ? scenario::Deed::stop
                : choice < *script.chance_stop + *script.chance_run ? scenario::Deed::run
                                                                    : scenario::Deed::go_on;
  stage.add(ActorKind::pedestrian, script);
  const double ahead = dice.in("parked_ahead_m");
  if (dice.happens("parked_share")) {
    park(stage, s, ahead, side);
  }
  const double aside = dice.in("second_aside_m");
  if (dice.happens("second_share")) {
    stage.add(ActorKind::pedestrian,
              {.start = {s + 4.0 * dice.even() - 1.0, -side * aside, side * right_angle},
               .behaviour = scenario::Behaviour::hold});
  }
  return stopping_after(script, std::abs(script.start.d) - 0.5 * stage.lane() - 0.5);
}

Harmless cyclist(Stage& stage) {
  Dice& dice = stage.dice;
  const double side = dice.side("from_left_share");
  const double pace = dice.in("ride_mps");
  const double overlap = dice.in("overlap");
  const double takes = dice.in("swerve_takes_s");
  stage.decision = Stage::approach - trigger;
  if (dice.happens("along_share")) {
    // Along our right edge, with us; swerves in before we pass.
    const double ride = std::min(pace, 0.9 * stage.speed);
    const double gap = 1.5 + (stage.speed - ride) * (trigger + 0.3 * takes) +
                       0.5 * Stage::length_of(ActorKind::bicycle);
    const double there = stage.speed * stage.decision + stage.front + gap;
    const world::LanePose start{there - ride * stage.decision, -0.5 * stage.lane() + 0.2, 0.0};
    const double target = stage.width * (overlap - 0.5);
    stage.add(ActorKind::bicycle,
              changing_lane(start, ride, target, stage.decision - 0.5 * takes, takes));
    scenario::Script stays{.start = start, .speed = ride};
    stays.start.d = -0.5 * stage.lane() - 0.5;
    return stays;
  }
  const double s = stage.head() + 0.5 * Stage::width_of(ActorKind::bicycle);
  const scenario::Script script =
      crossing_at(s, struck_at(stage, side, overlap), Stage::approach, -side * right_angle, pace);
  stage.add(ActorKind::bicycle, script);
  const double ahead = dice.in("parked_ahead_m");
  if (dice.happens("parked_share")) {
    park(stage, s, ahead, side);
  }
  return stopping_after(script, std::abs(script.start.d) - 0.5 * stage.lane() - 0.5 -
                                    0.5 * Stage::length_of(ActorKind::bicycle));
}

Harmless head_on(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double speed = dice.in("other_speed_mps");
  const double takes = dice.in("drift_takes_s");
  const double done = Stage::approach - dice.in("done_before_s");
  const double s = stage.head() + 0.5 * Stage::length_of(kind) + speed * Stage::approach;
  const world::LanePose start{s, stage.lane(), std::numbers::pi};
  stage.add(kind, changing_lane(start, speed, dice.in("drift_to_m"), done - takes, takes));
  stage.decision = Stage::approach - trigger;
  return scenario::Script{.start = start, .speed = speed};
}

Harmless merge(Stage& stage) {
  Dice& dice = stage.dice;
  const ActorKind kind = stage.any_vehicle();
  const double pace = stage.speed * dice.in("speed_share");
  const double begins = Stage::approach;
  const double s = stage.speed * begins + dice.in("ahead_m") - pace * begins;
  const world::LanePose start{s, -stage.lane(), 0.0};
  const double takes = dice.in("takes_s");
  stage.add(kind, changing_lane(start, pace, 0.0, begins, takes));
  stage.decision = begins + 0.3 * takes;
  scenario::Script waits{.start = start, .speed = pace, .behaviour = scenario::Behaviour::brake};
  waits.acceleration = dice.in("deceleration_mps2");
  waits.from = begins;
  return waits;
}

/// How long who stands needs for a way, until it has that pace.
double running_time(double way, double acceleration, double pace) {
  const double way_until_pace = 0.5 * pace * pace / acceleration;
  return way < way_until_pace ? std::sqrt(2.0 * way / acceleration)
                              : pace / acceleration + (way - way_until_pace) / pace;
}

Harmless dart_out(Stage& stage) {
  constexpr double between = 1.0;  // [m] from one parked car to the next: assumption
  Dice& dice = stage.dice;
  const double side = dice.side("from_left_share");
  const double pace = dice.in("run_mps");
  const double acceleration = dice.in("acceleration_mps2");
  const double gap = dice.in("parked_gap_m");
  const double row = dice.in("parked_row_m");
  const double s = stage.head() + 0.5 * Stage::width_of(ActorKind::pedestrian);
  const double stands = parked_aside(stage, side);
  const double way = stands - side * struck_at(stage, side, dice.in("overlap"));
  const scenario::Script waits{.start = {s, side * stands, -side * right_angle},
                               .behaviour = scenario::Behaviour::hold};
  scenario::Script runs = waits;
  runs.behaviour = scenario::Behaviour::accelerate;
  runs.acceleration = acceleration;
  runs.until_speed = pace;
  runs.from = Stage::approach - running_time(way, acceleration, pace);
  stage.add(ActorKind::pedestrian, runs);
  const double length = Stage::length_of(ActorKind::car);
  park(stage, s, 0.5 * gap + length, side);
  const double pitch = length + between;
  const int num_behind = static_cast<int>(std::ceil((row - 0.5 * gap) / pitch));
  for (int k = 0; k < num_behind; ++k) {
    park(stage, s, -0.5 * gap - k * pitch, side);
  }
  stage.decision = Stage::approach - trigger;
  return waits;
}

Harmless play(FamilyKind kind, Stage& stage) {
  switch (kind) {
    case FamilyKind::crossing:
      return crossing(stage);
    case FamilyKind::one_way:
      return one_way(stage);
    case FamilyKind::lead_brakes:
      return lead_brakes(stage);
    case FamilyKind::cut_in:
      return cut_in(stage);
    case FamilyKind::cut_out:
      return cut_out(stage);
    case FamilyKind::pedestrian:
      return pedestrian(stage);
    case FamilyKind::cyclist:
      return cyclist(stage);
    case FamilyKind::head_on:
      return head_on(stage);
    case FamilyKind::merge:
      return merge(stage);
    case FamilyKind::slower_lead:
      return slower_lead(stage);
    case FamilyKind::sideswipe:
      return sideswipe(stage);
    case FamilyKind::turning:
      return turning(stage);
    case FamilyKind::dart_out:
      break;
  }
  return dart_out(stage);
}

void label(const Family& family, std::uint64_t seed, std::uint64_t number, std::string_view car,
           FamilySample& found) {
  const std::string which = std::to_string(seed) + "_" + std::to_string(number);
  for (scenario::Scenario* scenario : {&found.scenario, &found.twin}) {
    scenario->title = family.title;
    scenario->source = "sample " + std::to_string(number) + " of seed " + std::to_string(seed) +
                       " of the family " + family.name + ", whose file cites each range";
    scenario->licence = "Apache-2.0";
    scenario->car = car;
  }
  found.scenario.name = family.name + "_" + which;
  found.twin.name = found.scenario.name + "_twin";
  found.twin.title += " (without risk)";
}

/// It keeps every rule of a scenario's file: room at the start, lane changes that somebody drives.
bool can_be_written(const scenario::Scenario& scenario, const world::Footprint& ego) {
  return scenario::read_scenario(scenario::write_scenario(scenario), scenario.name, ego)
      .has_value();
}

/// Nobody touches anybody: the others each other until well into the conflict, the ego somebody
/// until it must act.
bool is_sensible(const scenario::Scenario& scenario, const world::Footprint& ego, double decision) {
  constexpr double goes_on = 3.0;  // [s] into the conflict
  constexpr int steps_per_look = 5;
  sim::Traffic traffic(scenario);
  for (int k = 0; traffic.time() < decision + goes_on; ++k) {
    const world::EgoState state = scenario::ego_at(scenario, traffic.time());
    if (k % steps_per_look == 0) {
      const auto actors = traffic.actors();
      for (std::size_t i = 0; i < actors.size(); ++i) {
        const world::Actor& a = actors[i];
        if (traffic.time() <= decision &&
            world::separation(ego, state.X_WB, a.footprint, a.X_WA).distance <= 0.0) {
          return false;
        }
        for (std::size_t j = 0; j < i; ++j) {
          const world::Actor& b = actors[j];
          if (world::separation(a.footprint, a.X_WA, b.footprint, b.X_WA).distance <= 0.0) {
            return false;
          }
        }
      }
    }
    traffic.advance(state.X_WB, rotated(state.v_B, state.X_WB.yaw), ego);
  }
  return true;
}

}  // namespace

Result<FamilySample> sample(const Family& family, std::uint64_t seed, std::uint64_t number,
                            std::string_view car, const world::Footprint& ego) {
  Fnv of_family;  // two families have nothing in common, whatever the seed
  of_family.add(family.name);
  std::mt19937_64 rng = scenario::generator(seed ^ of_family.value(), number);
  const auto cues = family.cues ? draw_cues(*family.cues, rng) : std::vector<DrawnCue>{};
  const int tries = family.cues ? 2'000 : 100;  // what cues stand for has to find its place, too
  for (int k = 0; k < tries; ++k) {
    Dice dice(family, rng);
    Stage stage(dice, ego,
                family.kind == FamilyKind::crossing || family.kind == FamilyKind::turning);
    const Harmless harmless = play(family.kind, stage);
    const auto comers =
        family.cues ? add_cues(stage, cues, family.cues->law) : std::vector<Comer>{};
    stage.add_surroundings();
    const scenario::Scenario& with_all = stage.scenario;
    FamilySample found{.scenario = with_all, .twin = with_all, .cues = cues};
    take_absent_away(found.scenario, comers);
    take_all_away(found.twin, comers);
    take_leaves_away(found.twin);
    label(family, seed, number, car, found);
    if (harmless) {
      found.twin.actors.front().motion = *harmless;
    } else {
      found.twin.actors.erase(found.twin.actors.begin());
    }
    if ((comers.empty() || is_sensible(with_all, ego, stage.decision)) &&
        can_be_written(found.scenario, ego) && can_be_written(found.twin, ego) &&
        is_sensible(found.scenario, ego, stage.decision) &&
        is_sensible(found.twin, ego, stage.decision)) {
      return found;
    }
  }
  return Error{Error::Code::out_of_range,
               family.name + ": " + std::to_string(tries) + " draws of sample " +
                   std::to_string(number) + " of seed " + std::to_string(seed) +
                   " gave no encounter in which only the conflict itself is a contact: narrow its "
                   "ranges"};
}

}  // namespace saca::families
