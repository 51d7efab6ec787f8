#include "saca/onboard/reflex/atlas_judge.h"

#include <cmath>
#include <span>

#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/forecast/atlas_way.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::reflex {
namespace {

using manoeuvre::Plan;
using world::Scene;
using world::Track;

constexpr double looks_ahead = 10.0;          // [s]: nearly any stop
constexpr double reacting_step = 1.0 / 16.0;  // [s] of the ego, and of who reacts to it
constexpr double braking_step = 1.0 / 20.0;  // [s] of who goes on and brakes: its speed is read off
constexpr double even_step = 1.0 / 5.0;      // [s] of who goes on evenly
constexpr std::size_t room = static_cast<std::size_t>(looks_ahead / braking_step) + 2;

void write_going_on(const world::Actor& actor, double start, Track& track) {
  constexpr double even = 0.1;  // [m/s^2]
  track.start = start;
  track.step = norm(actor.a_W) < even ? even_step : braking_step;
  track.X_WA.clear();
  const long num_steps = std::lround(looks_ahead / track.step);
  for (long k = 0; k <= num_steps; ++k) {
    track.X_WA.push_back(world::actor_going_on(actor, static_cast<double>(k) * track.step));
  }
}

}  // namespace

AtlasJudge::AtlasJudge(const manoeuvre::Car& car, const atlas::Atlas& atlas,
                       const collision::HarmModel& harm, forecast::Braking braking)
    : car_(&car), atlas_(atlas), harm_(&harm), braking_(braking), tracks_(world::max_actors) {
  X_WB_.X_WA.reserve(room);
  for (Track& track : tracks_) {
    track.X_WA.reserve(room);
  }
}

std::optional<JudgedPlan> AtlasJudge::judged(const Plan& plan, const Scene& scene,
                                             const Followers& followers) noexcept {
  JudgedPlan one{.plan = plan, .drivable = !manoeuvre::why_refused(*car_, plan, scene)};
  if (!one.drivable) {
    return one;
  }
  if (atlas_.outside(plan, scene)) {
    return std::nullopt;
  }
  const std::span tracks(tracks_.data(), scene.actors.size());
  if (!followers.empty()) {
    forecast::atlas_way(atlas_, plan, scene, {.step = reacting_step, .longest = looks_ahead},
                        X_WB_);
    let_react(scene, followers, X_WB_, scene.time + looks_ahead, reacting_step, tracks);
  }
  const forecast::Future future = forecast::future(atlas_, plan, scene, tracks, *harm_);
  one.harm = future.harm;
  one.contact = future.probability;
  return future.outside ? std::nullopt : std::optional(one);
}

std::optional<Verdict> AtlasJudge::judge(const Scene& scene) noexcept {
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    write_going_on(scene.actors[i], scene.time, tracks_[i]);
  }
  const Followers followers = followers_of(scene);
  const Scene known = with_kept_gaps(scene, followers);
  Verdict verdict{.time = scene.time};
  for (const Plan& plan : forecast::all_plans(scene.ego.v_B.x, braking_)) {
    if (const auto one = judged(plan, known, followers)) {
      verdict.plans.push_back(*one);
    }
  }
  spread_over_strengths(verdict);
  return find_plan(verdict, manoeuvre::full_braking) == nullptr ? std::nullopt
                                                                : std::optional(verdict);
}

}  // namespace saca::reflex
