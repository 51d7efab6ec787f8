#include "saca/runtime/avoider.h"

#include "saca/base/core/contract.h"

namespace saca {
namespace {

constexpr double quiet_time = 2.0;  // [s] without threat or plan, after which an encounter is over

const AvoiderSetup& complete(const AvoiderSetup& setup) {
  expects(setup.intent != nullptr && setup.planes.forecast.car != nullptr &&
              setup.planes.forecast.harm != nullptr && setup.planes.clock != nullptr,
          "car, harm, intent and clock are given");
  return setup;
}

}  // namespace

Avoider::Avoider(const AvoiderSetup& setup)
    : setup_(complete(setup)),
      observer_(*setup.intent),
      events_(most_events),
      planes_(setup.planes,
              setup.thinking.value_or(runtime::Planes::Listener{
                  .event = [this](const arbitration::Event& event) { events_.thought(event); }}),
              setup.num_timed) {}

Answer Avoider::step(const world::Scene& scene, Clock::Time at) {
  return answer(intake_.take(scene), at);
}

Answer Avoider::step(double now, Clock::Time at) {
  return answer(intake_.carry_on(now), at);
}

Answer Avoider::answer(const runtime::IntakeResult& taken, Clock::Time at) {
  Answer answer{.plan = plan(), .degraded = taken.degraded};
  remark_on(taken);
  if (!taken.usable) {
    return answer;  // what is under way goes on
  }
  const world::Scene& scene = intake_.scene();
  if (taken.new_drive) {
    observer_ = intent::Observer(*setup_.intent);
    begin_anew(runtime::Reset::drive);
  }
  const intent::Beliefs& beliefs = observer_.look(scene);
  grip_ = scene.grip;
  const reflex::Reflex reflex = planes_.step(scene, beliefs, at, finished_);
  answer.threat = reflex.threat;
  answer.triggered = reflex.triggered;
  answer.switched = reflex.switched;
  answer.begins = reflex.triggered || reflex.switched.has_value();
  if (answer.begins) {
    begin(reflex.plan, scene);
  }
  if (reflex.triggered) {
    events_.triggered(*planes_.decision(), scene.actors[reflex.threat->actor], reflex.threat->time);
  } else if (reflex.switched) {
    events_.switched(scene.time, *reflex.switched);
  }
  look_for_the_end(scene, answer);
  answer.plan = plan();
  return answer;
}

void Avoider::remark_on(const runtime::IntakeResult& taken) {
  using runtime::Remark;
  const double time = intake_.scene().time;
  if (taken.new_drive && watches_) {
    events_.remark(time, Remark::new_drive);
  }
  watches_ = watches_ || taken.usable;
  const Remark now = !taken.usable    ? Remark::unusable
                     : taken.degraded ? Remark::degraded
                                      : Remark::seen_again;
  if (now != perception_) {
    events_.remark(time, now);
    perception_ = now;
  }
}

void Avoider::begin(const manoeuvre::Plan& plan, const world::Scene& scene) {
  finished_ = false;
  if (plan.policy == manoeuvre::PolicyId::no_intervention) {
    execution_.reset();  // the stack drives
    return;
  }
  execution_.emplace(*setup_.planes.forecast.car, plan, scene);
}

void Avoider::look_for_the_end(const world::Scene& scene, const Answer& answer) {
  constexpr double rest = 0.1;  // [m/s]
  if (finished_ && execution_ && norm(scene.ego.v_B) >= rest) {
    execution_.reset();  // a lane has been recovered; who has come to rest is held
  }
  meets_somebody_ = meets_somebody_ || answer.threat || execution_;
  if (!meets_somebody_ || answer.threat || (execution_ && !finished_)) {
    quiet_.reset();
    return;
  }
  quiet_ = quiet_.value_or(scene.time);
  if (scene.time >= *quiet_ + quiet_time) {
    end_encounter();
  }
}

void Avoider::end_encounter() {
  begin_anew(runtime::Reset::encounter);
  ++num_encounters_;
  events_.remark(intake_.scene().time, runtime::Remark::encounter_over);
}

void Avoider::stand_down() {
  if (meets_somebody_) {
    end_encounter();
  }
}

void Avoider::begin_anew(runtime::Reset forgotten) {
  planes_.begin_anew(forgotten);
  execution_.reset();
  quiet_.reset();
  meets_somebody_ = false;
  finished_ = false;
}

vehicle::Command Avoider::control(const vehicle::VehicleState& state, double dt) noexcept {
  if (!execution_) {
    return {};
  }
  const vehicle::Command command = execution_->control(state, grip_, dt);
  finished_ = execution_->finished();
  return command;
}

}  // namespace saca
