#include "saca/decide/trigger_check.h"

#include <cmath>
#include <span>

#include "saca/outcome/atlas_way.h"
#include "saca/outcome/futures.h"
#include "saca/outcome/ordering.h"
#include "saca/world/time_to_conflict.h"

namespace saca::decide {
namespace {

using manoeuvre::Plan;
using world::Scene;
using world::Track;

constexpr double looks_ahead = 10.0;  // [s]: nearly any stop
constexpr double coarse = 0.1;        // [s] between poses of who goes on as it does
constexpr double fine = 0.05;         // [s] of the ego, and of who reacts to it

std::size_t room_for(double step) {
  return static_cast<std::size_t>(std::lround(looks_ahead / step)) + 2;
}

void write_going_on(const world::Actor& actor, double start, Track& track) {
  track.start = start;
  track.step = coarse;
  track.X_WA.clear();
  const int num_steps = static_cast<int>(std::lround(looks_ahead / coarse));
  for (int k = 0; k <= num_steps; ++k) {
    track.X_WA.push_back(world::actor_going_on(actor, k * coarse));
  }
}

}  // namespace

bool Comparison::plan_harms_more() const {
  return outcome::harm_class(plan) > outcome::harm_class(aeb);
}

TriggerCheck::TriggerCheck(const manoeuvre::Atlas& atlas, const outcome::HarmModel& harm)
    : atlas_(atlas), harm_(&harm), tracks_(world::max_actors) {
  X_WB_.X_WA.reserve(room_for(fine));
  for (Track& track : tracks_) {
    track.X_WA.reserve(room_for(fine));
  }
}

std::optional<double> TriggerCheck::harm_of(const Plan& plan, const Scene& scene,
                                            const preview::Followers& followers) noexcept {
  if (atlas_.outside(plan, scene)) {
    return std::nullopt;
  }
  const std::span tracks(tracks_.data(), scene.actors.size());
  if (!followers.empty()) {
    outcome::atlas_way(atlas_, plan, scene, {.step = fine, .longest = looks_ahead}, X_WB_);
    preview::let_react(scene, followers, X_WB_, scene.time + looks_ahead, fine, tracks);
  }
  const outcome::Future future = outcome::future(atlas_, plan, scene, tracks, *harm_);
  return future.outside ? std::nullopt : std::optional(future.harm);
}

std::optional<Comparison> TriggerCheck::compare(const Plan& plan, const Scene& scene) noexcept {
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    write_going_on(scene.actors[i], scene.time, tracks_[i]);
  }
  const preview::Followers followers = preview::followers_of(scene);
  const auto of_plan = harm_of(plan, scene, followers);
  const auto of_aeb = harm_of({manoeuvre::PolicyId::aeb, std::nullopt}, scene, followers);
  if (!of_plan || !of_aeb) {
    return std::nullopt;
  }
  return Comparison{*of_plan, *of_aeb};
}

}  // namespace saca::decide
