#include "saca/runtime/avoider.h"

#include "saca/base/core/contract.h"

namespace saca {
namespace {

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
      encounter_(*setup.planes.forecast.car),
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

Answer Avoider::answer(const reflex::IntakeResult& taken, Clock::Time at) {
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
  const reflex::Reflex reflex = planes_.step(scene, beliefs, at, finished());
  answer.threat = reflex.threat;
  answer.triggered = reflex.triggered;
  answer.switched = reflex.switched;
  answer.begins = reflex.triggered || reflex.switched.has_value();
  const bool is_over = encounter_.look(scene, reflex);
  if (reflex.triggered) {
    events_.triggered(*planes_.decision(), scene.actors[reflex.threat->actor], reflex.threat->time);
  } else if (reflex.switched) {
    events_.switched(scene.time, *reflex.switched);
  }
  if (is_over) {
    end_encounter();
  }
  answer.plan = plan();
  return answer;
}

void Avoider::remark_on(const reflex::IntakeResult& taken) {
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

void Avoider::end_encounter() {
  begin_anew(runtime::Reset::encounter);
  ++num_encounters_;
  events_.remark(intake_.scene().time, runtime::Remark::encounter_over);
}

void Avoider::stand_down() {
  if (encounter_.meets_somebody()) {
    end_encounter();
  }
}

void Avoider::begin_anew(runtime::Reset forgotten) {
  planes_.begin_anew(forgotten);
  encounter_.begin_anew();
}

vehicle::Command Avoider::control(const vehicle::VehicleState& state, double dt) noexcept {
  return encounter_.control(state, dt);
}

}  // namespace saca
