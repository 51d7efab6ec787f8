#include "saca/lab/sim/traffic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/lab/scenario/motion.h"
#include "saca/onboard/collision/impact.h"

namespace saca::sim {
namespace {

constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
constexpr double nearly = 1e-9;  // [s]: times are multiples of a step up to rounding

Vec2 slope(const Pose& from, const Pose& to) {
  return (1.0 / Traffic::step) * (to.p - from.p);
}

}  // namespace

Traffic::Traffic(const scenario::Scenario& scenario, const scenario::Chance& chance)
    : scenario_(&scenario),
      chance_(chance),
      grip_(std::min(1.2, scenario.grip * chance.car.grip)),
      members_(scenario.actors.size()) {
  expects(scenario.actors.size() <= world::max_actors, "at most 32 actors");
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    member.appears = scenario::appears_at(scenario, i, chance_);
    const scenario::ScenarioActor& actor = scenario.actors[i];
    if (scenario::reacts(actor)) {
      const auto& script = std::get<scenario::Script>(actor.motion);
      const scenario::ActorChance& drawn = chance_.actors[i];
      const Pose X_WA = scenario::start_pose(scenario, i) * Pose{{drawn.ahead, drawn.aside}, 0.0};
      const double factor = chance_.from <= 0.0 ? drawn.speed : 1.0;
      drivers::DriverLaw law = script.law;
      law.desired_speed *= factor;
      appoint(i, X_WA, factor * script.speed, law);
    } else {
      member.next = scenario::actor_pose(scenario, i, step, chance_);
      member.now.X_WA = scenario::actor_pose(scenario, i, 0.0, chance_);
      member.now.v_W = slope(member.now.X_WA, member.next);
    }
    note(member);
  }
}

void Traffic::appoint(std::size_t actor, const Pose& X_WA, double speed, drivers::DriverLaw law) {
  const scenario::ActorChance& drawn = chance_.actors[actor];
  law.reaction = std::min(drivers::longest_reaction, drawn.reaction * law.reaction);
  law.acceleration *= drawn.strength;
  law.comfortable *= drawn.strength;
  law.hardest *= drawn.strength;
  Member& member = members_[actor];
  member.driver.emplace(scenario_->road, scenario_->actors[actor].footprint, X_WA,
                        drivers::Driver(law, speed, grip_, step));
  member.now = {member.driver->pose(), member.driver->velocity()};
}

bool Traffic::is_there(std::size_t actor) const {
  return members_[actor].appears <= time() + nearly;
}

void Traffic::note(Member& member) const {
  if (member.appears <= time() + nearly) {
    member.seen[member.num_seen % member.seen.size()] = member.now;
    ++member.num_seen;
  }
}

std::vector<drivers::Ahead> Traffic::views(const Pose& X_WB, Vec2 v_W,
                                           const world::Footprint& ego) const {
  std::vector<drivers::Ahead> all(members_.size());
  const bool anybody = std::any_of(members_.begin(), members_.end(),
                                   [](const Member& member) { return member.driver.has_value(); });
  if (!anybody) {
    return all;
  }
  std::vector<drivers::Present> there{drivers::present(scenario_->road, ego, X_WB, v_W)};
  std::vector<std::size_t> place(members_.size(), nobody);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (is_there(i) && !scenario_->actors[i].ghost) {
      place[i] = there.size();
      there.push_back(drivers::present(scenario_->road, scenario_->actors[i].footprint,
                                       members_[i].now.X_WA, members_[i].now.v_W));
    }
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].driver) {
      all[i] = members_[i].driver->ahead(there, place[i]);
    }
  }
  return all;
}

void Traffic::advance(const Pose& X_WB, Vec2 v_W, const world::Footprint& ego) {
  if (followers_react_) {
    release_followers(X_WB, v_W, ego);
  }
  const std::vector<drivers::Ahead> ahead = views(X_WB, v_W, ego);
  const double before = time();
  ++num_steps_;
  const bool differs_from_now = before < chance_.from && time() >= chance_.from;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    if (member.driver) {
      member.driver->advance(ahead[i]);
      if (differs_from_now) {
        member.driver->driver().speed_up(chance_.actors[i].speed);
      }
      member.now = {member.driver->pose(), member.driver->velocity()};
    } else {
      member.now.X_WA = member.next;
      member.next = scenario::actor_pose(*scenario_, i, time() + step, chance_);
      member.now.v_W = slope(member.now.X_WA, member.next);
    }
    note(member);
  }
}

void Traffic::release_followers(const Pose& X_WB, Vec2 v_W, const world::Footprint& ego) {
  const world::Scene scene{.time = time(),
                           .ego = {.X_WB = X_WB, .v_B = rotated(v_W, -X_WB.yaw)},
                           .ego_footprint = ego,
                           .road = scenario_->road};
  std::vector<std::size_t> released;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const scenario::ScenarioActor& actor = scenario_->actors[i];
    if (std::holds_alternative<scenario::Recording>(actor.motion) && !members_[i].driver &&
        !actor.ghost && is_there(i) && world::is_follower(scene, as_known(i))) {
      const double speed = norm(members_[i].now.v_W);
      appoint(i, members_[i].now.X_WA, speed, drivers::usual_driver(speed));
      released.push_back(i);
    }
  }
  if (released.empty()) {
    return;
  }
  const std::vector<drivers::Ahead> ahead = views(X_WB, v_W, ego);
  for (const std::size_t i : released) {
    const double speed = members_[i].driver->driver().speed();
    appoint(i, members_[i].now.X_WA, speed,
            content_with(drivers::usual_driver(speed), speed, ahead[i].gap));
  }
}

world::Actor Traffic::as_known(std::size_t actor) const {
  const scenario::ScenarioActor& it = scenario_->actors[actor];
  const Member& member = members_[actor];
  world::Actor known{.id = it.id,
                     .kind = it.kind,
                     .footprint = it.footprint,
                     .mass = it.mass,
                     .X_WA = member.now.X_WA,
                     .v_W = member.now.v_W,
                     .existence = it.ghost ? it.existence : 1.0};
  if (member.num_seen > steps_looked_back) {
    const Motion& then = member.seen[member.num_seen % member.seen.size()];  // the oldest
    constexpr double rate = 1.0 / (steps_looked_back * step);
    known.a_W = rate * (known.v_W - then.v_W);
    known.yaw_rate = rate * wrap_angle(known.X_WA.yaw - then.X_WA.yaw);
  }
  return known;
}

StaticVector<world::Actor, world::max_actors> Traffic::present(bool ghosts) const {
  StaticVector<world::Actor, world::max_actors> there;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (is_there(i) && scenario_->actors[i].ghost == ghosts) {
      there.push_back(as_known(i));
    }
  }
  return there;
}

StaticVector<world::Actor, world::max_actors> Traffic::actors() const {
  return present(false);
}
StaticVector<world::Actor, world::max_actors> Traffic::ghosts() const {
  return present(true);
}

StaticVector<world::Actor, world::max_actors> Traffic::cast() const {
  StaticVector<world::Actor, world::max_actors> all;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!scenario_->actors[i].ghost) {
      all.push_back(as_known(i));
    }
  }
  return all;
}

std::vector<world::Track> Traffic::against(const manoeuvre::EgoMotion& motion,
                                           const world::Footprint& ego, double until) const {
  std::vector<std::size_t> cast;
  std::vector<world::Track> tracks;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!scenario_->actors[i].ghost) {
      cast.push_back(i);
      tracks.push_back({.step = step, .X_WA = {}});
    }
  }
  Traffic later = *this;
  const auto note = [&] {
    for (std::size_t i = 0; i < cast.size(); ++i) {
      if (later.is_there(cast[i])) {
        if (tracks[i].X_WA.empty()) {
          tracks[i].start = later.time();
        }
        tracks[i].X_WA.push_back(later.members_[cast[i]].now.X_WA);
      }
    }
  };
  note();
  while (later.time() < until - nearly) {
    const collision::Instant now = collision::instant_at(motion, later.time());
    later.advance(now.X_WB, now.v_W, ego);
    note();
  }
  for (std::size_t i = 0; i < cast.size(); ++i) {
    if (tracks[i].X_WA.empty()) {  // it appears after all this
      tracks[i].start = members_[cast[i]].appears;
      tracks[i].X_WA.push_back(later.members_[cast[i]].now.X_WA);
    }
  }
  return tracks;
}

}  // namespace saca::sim
