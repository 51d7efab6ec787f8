#include "saca/lab/suites/shadow.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/eval/shadow_judge.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/sim/stepper.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/track_confirmation.h"
#include "saca/runtime/avoider.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/preview/caution.h"
#include "saca/thinking/preview/previewed_threat.h"

namespace saca::suites {
namespace {

constexpr double least_recorded = 1.0;  // of the ego [s]
constexpr double shown_for = 3.0;       // in pictures [s]
constexpr double shown_step = 0.05;     // [s]
constexpr double nearly_now = 1e-9;     // [s]: times are multiples of a step up to rounding

// --- what cannot be watched

std::optional<std::string> flaw_of(const scenario::Recording& recording) {
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const scenario::Sample& sample = recording[i];
    if (!std::isfinite(sample.time) || !std::isfinite(sample.X_WA.p.x) ||
        !std::isfinite(sample.X_WA.p.y) || !std::isfinite(sample.X_WA.yaw) ||
        !std::isfinite(sample.speed) || !std::isfinite(sample.yaw_rate)) {
      return fmt::format("sample {}: want finite numbers", i);
    }
    if (i > 0 && sample.time <= recording[i - 1].time) {
      return fmt::format("sample {}: want times that grow, got {} s after {} s", i, sample.time,
                         recording[i - 1].time);
    }
  }
  return std::nullopt;
}

std::optional<Error> unwatchable(const scenario::Scenario& scenario) {
  const auto error = [&](const std::string& message) {
    return Error{Error::Code::out_of_range, scenario.name + ": " + message};
  };
  const auto* ego = std::get_if<scenario::Recording>(&scenario.ego);
  if (ego == nullptr || ego->size() < 2) {
    return error("ego: want a recording of two samples or more");
  }
  if (const auto flaw = flaw_of(*ego)) {
    return error("ego: " + *flaw);
  }
  if (ego->front().time > nearly_now || ego->back().time < least_recorded - nearly_now) {
    return error(fmt::format("ego: want a recording from 0 to {} s or more, got {} to {} s",
                             least_recorded, ego->front().time, ego->back().time));
  }
  for (const scenario::ScenarioActor& actor : scenario.actors) {
    if (const auto* recording = std::get_if<scenario::Recording>(&actor.motion)) {
      const auto flaw =
          recording->empty() ? std::optional<std::string>("want samples") : flaw_of(*recording);
      if (flaw) {
        return error(scenario::actor_name(actor) + ": " + *flaw);
      }
    }
  }
  return std::nullopt;
}

// --- watching

/// Who is there by the recording: nobody beyond the last sample.
void drop_who_is_gone(const scenario::Scenario& scenario, world::Scene& scene) {
  StaticVector<world::Actor, world::max_actors> there;
  for (const world::Actor& actor : scene.actors) {
    const scenario::Recording* recording = std::get_if<scenario::Recording>(
        &scenario.actors[eval::actor_index(scenario, actor)].motion);
    if (recording == nullptr || scene.time <= recording->back().time + nearly_now) {
      there.push_back(actor);
    }
  }
  scene.actors = there;
}

/// Puts what holds now and then into one piece where it lies no farther apart than rearmed_after.
class Arming {
 public:
  /// @return  whether something new begins
  bool look(double time, bool holds) {
    const bool begins = holds && (!last_ || time - *last_ > rearmed_after + nearly_now);
    if (holds) {
      last_ = time;
    }
    return begins;
  }

 private:
  std::optional<double> last_;
};

/// The ego gets to where the lane is not known, or is about to turn off.
bool leaves_lane(const world::Scene& scene, double lane_ahead, double look_ahead) {
  constexpr double turning_off = from_degrees(20.0);
  const world::LanePose pose = world::to_lane(scene.road, scene.ego.X_WB);
  return pose.s + look_ahead * norm(scene.ego.v_B) > lane_ahead ||
         std::abs(pose.heading) >= turning_off;
}

void advance_to_next_look(sim::Stepper& stepper) {
  for (int k = 0; k < encounter::ClosedLoop::steps_per_look; ++k) {
    stepper.advance({});
  }
}

const ShadowSetup& complete_shadow(const ShadowSetup& setup) {
  expects(setup.car != nullptr && setup.intent != nullptr, "car and intent are given");
  expects(setup.saca == nullptr || setup.saca->forecast.car == setup.car,
          "who decides is of the same car");
  return setup;
}

/// SACA as it ships, whose wheel is never its own.
class Decider {
 public:
  Decider(const ShadowSetup& setup)
      : avoider_({.planes = planes_of(setup), .intent = setup.intent}) {}

  /// @return  what it begins in this very look, its judgement still missing; nullopt: nothing
  std::optional<ShadowIntervention> look(const world::Scene& seen) {
    const Answer answer = avoider_.step(seen, from_seconds(seen.time));
    const world::Scene& scene = avoider_.scene();
    if (answer.threat) {
      feared_ = scene.actors[answer.threat->actor];
      time_to_conflict_ = answer.threat->time;
    }
    if (!answer.begins || !answer.plan || !feared_) {
      return std::nullopt;
    }
    const auto& decision = avoider_.decision();
    ShadowIntervention begun{
        .trigger = {.time = seen.time,
                    .who = actor_name(*feared_),
                    .time_to_conflict = time_to_conflict_,
                    .speed = norm(seen.ego.v_B),
                    .judgement = {}},
        .plan = manoeuvre::plan_name(*answer.plan),
        .early = answer.triggered && decision && decision->waiting_cost.has_value()};
    avoider_.stand_down();
    return begun;
  }
  /// Whom it feared last; nullptr: nobody so far.
  [[nodiscard]] const world::Actor* feared() const { return feared_ ? &*feared_ : nullptr; }

 private:
  static runtime::PlanesSetup planes_of(const ShadowSetup& setup) {
    runtime::PlanesSetup planes = *setup.saca;
    planes.thresholds = setup.thresholds;
    return planes;
  }

  Avoider avoider_;
  std::optional<world::Actor> feared_;
  double time_to_conflict_ = 0.0;
};

/// What is found in a drive.
class DriveFindings {
 public:
  /// What it is given outlives it.
  DriveFindings(const scenario::Scenario& world, const ShadowSetup& setup,
                const eval::ShadowWindow& window)
      : world_(world), setup_(setup), window_(window) {}

  void note_preview(const world::Scene& seen, const intent::Beliefs& beliefs) {
    const auto near =
        preview::previewed_threat(seen, beliefs, preview::hard_driving(), setup_.thresholds);
    if (preview_.look(seen.time, near.has_value())) {
      drive_.previews.push_back({seen.time, seen.time, actor_name(seen.actors[near->actor])});
    } else if (near) {
      drive_.previews.back().to = seen.time;
    }
  }
  void note_trigger(const world::Scene& seen, const reflex::TrackConfirmation& tracks) {
    const auto threat = reflex::triggering_threat(seen, setup_.thresholds, tracks.confirmed());
    if (trigger_.look(seen.time, threat.has_value())) {
      const world::Actor& who = seen.actors[threat->actor];
      drive_.triggers.push_back({seen.time, actor_name(who), threat->time, norm(seen.ego.v_B),
                                 judgement(who, seen.time)});
    }
  }
  /// @param begun   what the one who decides begins in this look
  /// @param feared  for whom; not null where something begins
  void note_intervention(const world::Scene& seen, std::optional<ShadowIntervention> begun,
                         const world::Actor* feared) {
    if (intervention_.look(seen.time, begun.has_value())) {
      begun->trigger.judgement = judgement(*feared, seen.time);
      drive_.interventions.push_back(*std::move(begun));
    }
  }
  void note_way(const world::Scene& seen) {
    if (last_p_W_) {
      drive_.metres += norm(seen.ego.X_WB.p - *last_p_W_);
      ++num_steps_;
    }
    last_p_W_ = seen.ego.X_WB.p;
  }
  [[nodiscard]] ShadowDrive all() && {
    drive_.seconds = num_steps_ * encounter::ClosedLoop::step;
    return std::move(drive_);
  }

 private:
  [[nodiscard]] eval::ShadowJudgement judgement(const world::Actor& who, double time) const {
    return judged(world_, manoeuvre::footprint(*setup_.car), eval::actor_index(world_, who), time,
                  window_);
  }

  const scenario::Scenario& world_;
  const ShadowSetup& setup_;
  const eval::ShadowWindow& window_;
  ShadowDrive drive_;
  Arming preview_;
  Arming trigger_;
  Arming intervention_;
  std::optional<Vec2> last_p_W_;  // at the look before, if it counts
  int num_steps_ = 0;
};

world::Track track_to(double from, double to, const auto& pose) {
  world::Track track{.start = from, .step = shown_step, .X_WA = {}};
  const auto num_steps = static_cast<int>(std::floor((to - from) / shown_step + nearly_now));
  for (int k = 0; k <= std::max(0, num_steps); ++k) {
    track.X_WA.push_back(pose(k * shown_step));
  }
  return track;
}

}  // namespace

Result<ShadowDrive> shadow_drive(const scenario::Scenario& scenario, const ShadowSetup& setup,
                                 const eval::ShadowWindow& window) {
  complete_shadow(setup);
  expects(window.from >= 0.0 && (!window.until || *window.until > window.from),
          "0 <= from < until");
  if (auto problem = unwatchable(scenario)) {
    return *std::move(problem);
  }
  scenario::Scenario world = scenario;
  world.perception = {};
  const double recorded = std::get<scenario::Recording>(world.ego).back().time;
  const double end = std::min(recorded, window.until.value_or(recorded));
  const auto num_looks = static_cast<int>(std::floor(end / encounter::ClosedLoop::step + 1e-6));
  sim::Stepper stepper(world, *setup.car);
  intent::Observer observer(*setup.intent);
  reflex::TrackConfirmation tracks;
  DriveFindings findings(world, setup, window);
  std::optional<Decider> decider;
  if (setup.saca != nullptr) {
    decider.emplace(setup);
  }
  for (int k = 0; k <= num_looks; ++k) {
    world::Scene seen = stepper.perceive();
    drop_who_is_gone(world, seen);
    if (const auto rule = world::broken_rule(seen)) {
      return Error{Error::Code::out_of_range, fmt::format("{}: at {:.2f} s: a scene must hold: {}",
                                                          world.name, seen.time, *rule)};
    }
    const intent::Beliefs& beliefs = observer.look(seen);
    tracks.look(seen);
    auto begun = decider ? decider->look(seen) : std::nullopt;
    if (seen.time >= window.from - nearly_now) {
      if (window.lane_ahead && leaves_lane(seen, *window.lane_ahead, setup.thresholds.trigger)) {
        break;
      }
      findings.note_preview(seen, beliefs);
      findings.note_trigger(seen, tracks);
      findings.note_intervention(seen, std::move(begun), decider ? decider->feared() : nullptr);
      findings.note_way(seen);
    }
    advance_to_next_look(stepper);
  }
  return std::move(findings).all();
}

ShadowPicture shadow_picture(const scenario::Scenario& scenario, const ShadowSetup& setup,
                             const ShadowTrigger& trigger) {
  complete_shadow(setup);
  scenario::Scenario world = scenario;
  world.perception = {};
  sim::Stepper stepper(world, *setup.car);
  while (stepper.time() < trigger.time - nearly_now) {
    advance_to_next_look(stepper);
  }
  ShadowPicture picture;
  picture.scene = stepper.scene();
  drop_who_is_gone(world, picture.scene);
  const world::Scene& scene = picture.scene;
  const double now = scene.time;
  const double recorded = std::get<scenario::Recording>(world.ego).back().time;
  picture.ego = track_to(now, std::min(now + shown_for, recorded),
                         [&](double t) { return scenario::ego_at(world, now + t).X_WB; });
  const double conflict = now + trigger.time_to_conflict;
  picture.supposed_ego = track_to(now, conflict, [&](double t) {
    return world::ego_going_on(scene, t, world::EgoPrediction::as_measured);
  });
  for (const world::Actor& actor : scene.actors) {
    const std::size_t i = eval::actor_index(world, actor);
    const auto* recording = std::get_if<scenario::Recording>(&world.actors[i].motion);
    const double last = recording == nullptr ? now + shown_for : recording->back().time;
    picture.others.push_back(track_to(now, std::min(now + shown_for, last), [&](double t) {
      return scenario::actor_pose(world, i, now + t, {});
    }));
    picture.supposed_others.push_back(
        track_to(now, conflict, [&](double t) { return world::actor_going_on(actor, t); }));
  }
  return picture;
}

}  // namespace saca::suites
