#include "saca/loop/encounter.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <utility>

#include "saca/core/latest_slot.h"
#include "saca/core/names.h"
#include "saca/decide/thinking_plane.h"
#include "saca/intent/observer.h"
#include "saca/loop/charged_thinking.h"
#include "saca/loop/thinking_thread.h"
#include "saca/loop/witness.h"
#include "saca/manoeuvre/controller.h"
#include "saca/manoeuvre/drive.h"
#include "saca/outcome/describe.h"
#include "saca/preview/preview.h"
#include "saca/sim/stepper.h"
#include "saca/world/time_to_conflict.h"

namespace saca::loop {
namespace {

using decide::Event;
using decide::EventKind;
using decide::Plane;
using manoeuvre::PolicyId;
using world::Scene;

constexpr std::array<std::string_view, 2> pace_names{"real", "lockstep"};
constexpr std::array<std::string_view, 3> phase_names{"recorded", "driving", "manoeuvre"};

constexpr int steps_per_look = 10;       // 100 Hz
constexpr int looks_per_frame = 2;       // 50 Hz
constexpr int looks_per_judgement = 10;  // 10 Hz, as intent::Observer judges
constexpr double rest_after_end = 2.0;   // [s] that the film goes on, as outcome::judge looks on

std::string policy_text(const manoeuvre::Plan& plan) {
  std::string text = fmt::format("{} {}", manoeuvre::index(plan.policy), name(plan.policy));
  if (plan.target_speed) {
    text += fmt::format(" to {:.1f} m/s", *plan.target_speed);
  }
  return text;
}

/// The ego has stopped, and somebody behind it has not.
bool is_approached(const Scene& scene) {
  constexpr double moves = 0.1;  // [m/s]
  return norm(scene.ego.v_B) < moves &&
         std::any_of(scene.actors.begin(), scene.actors.end(), [&](const world::Actor& actor) {
           return norm(actor.v_W) > moves && world::is_follower(scene, actor);
         });
}

/// One encounter under way.
class Encounter {
 public:
  Encounter(const Setup& setup, Listener& listener)
      : setup_(setup),
        listener_(listener),
        charged_model_(setup.model == nullptr
                           ? nullptr
                           : std::make_unique<ChargedModel>(*setup.model, setup.costs, *setup.clock,
                                                            simulated_clock_)),
        charged_(setup.costs.preview, simulated_clock_),
        stepper_(*setup.scenario, *setup.car,
                 setup.seed ? sim::draw_chance(*setup.seed, 0, 0.0) : sim::Chance{}),
        observer_(*setup.intent),
        witness_(*setup.harm),
        reflex_(setup.thresholds, trigger_check(setup), forced_plan(setup)),
        plane_(tools(), setup.thresholds, output()) {}

  Result<Record> play();

 private:
  [[nodiscard]] bool real() const { return setup_.pace == Pace::real; }
  static std::optional<decide::TriggerCheck> trigger_check(const Setup& setup);
  static std::optional<manoeuvre::Plan> forced_plan(const Setup& setup);
  [[nodiscard]] decide::ThinkingTools tools();
  [[nodiscard]] decide::ThinkingOutput output();

  void tell(Plane plane, EventKind kind, std::string text);
  [[nodiscard]] std::optional<Error> look();
  void wake();
  decide::Reflex react();
  void hand_over_plans();
  void execute(const preview::Threat& threat);
  void film(const Scene& scene, const decide::Reflex& reflex);
  [[nodiscard]] bool over() const;
  void conclude();
  void compare_with_driver();
  void learn();

  const Setup& setup_;
  Listener& listener_;
  Record record_;
  ManualClock simulated_clock_;
  std::unique_ptr<ChargedModel> charged_model_;
  ChargedThinking charged_;
  sim::Stepper stepper_;
  intent::Observer observer_;
  Witness witness_;
  decide::ReflexPlane reflex_;
  LatestSlot<TimedScene> scenes_;
  LatestSlot<decide::PlanCache> plans_;
  std::mutex thinking_events_lock_;  // of the thinking thread and the end of the run only
  std::vector<Event> thinking_events_;
  decide::ThinkingPlane plane_;

  Clock::Time start_{0};
  int num_looks_ = 0;
  std::optional<double> woke_;   ///< when SACA took the wheel [s]
  std::optional<double> ended_;  ///< when the manoeuvre was finished [s]
  bool threatened_ = false;      ///< somebody may still run into the ego
  bool contact_ = false;
  manoeuvre::Plan plan_{PolicyId::no_intervention, std::nullopt};
  manoeuvre::ControllerState controller_;
  std::vector<double> reflex_times_;
  Scene seen_;                                ///< what SACA perceives at the last look
  const intent::Beliefs* beliefs_ = nullptr;  ///< about those in `seen_`, of `observer_`
  Scene seen_at_trigger_;                     ///< likewise then
  outcome::Others others_at_trigger_;
};

std::optional<decide::TriggerCheck> Encounter::trigger_check(const Setup& setup) {
  return setup.atlas == nullptr
             ? std::nullopt
             : std::optional<decide::TriggerCheck>(std::in_place, *setup.atlas, *setup.harm);
}

std::optional<manoeuvre::Plan> Encounter::forced_plan(const Setup& setup) {
  if (!setup.forced) {
    return std::nullopt;
  }
  return manoeuvre::Plan{*setup.forced, std::nullopt};  // its target speed is set at the trigger
}

decide::ThinkingTools Encounter::tools() {
  decide::ThinkingTools tools{.forecast = {setup_.car, setup_.harm, setup_.atlas, setup_.danger},
                              .memory = setup_.memory,
                              .model = setup_.model,
                              .clock = setup_.clock};
  if (!real()) {
    tools.model = charged_model_.get();
    tools.clock = &simulated_clock_;
  }
  return tools;
}

decide::ThinkingOutput Encounter::output() {
  return {.publish =
              [this](const decide::PlanCache& plans, double ready) {
                real() ? plans_.publish(plans) : charged_.publish(plans, ready);
              },
          .event =
              [this](const Event& event) {
                {
                  const std::lock_guard guard(thinking_events_lock_);
                  thinking_events_.push_back(event);
                }
                listener_.on_event(event);
              },
          .reasoning = [this](std::int32_t preview,
                              std::string_view text) { listener_.on_reasoning(preview, text); }};
}

void Encounter::tell(Plane plane, EventKind kind, std::string text) {
  record_.events.push_back({stepper_.time(), plane, kind, std::move(text)});
  listener_.on_event(record_.events.back());
}

Result<Record> Encounter::play() {
  reflex_times_.reserve(static_cast<std::size_t>(setup_.scenario->duration * 100.0) + 2);
  start_ = setup_.clock->now();
  std::string thinking_fault;
  {
    std::unique_ptr<ThinkingThread> thread;
    if (real()) {
      thread = std::make_unique<ThinkingThread>(plane_, scenes_, *setup_.clock);
    }
    while (!over()) {
      if (const auto problem = look()) {
        return *problem;
      }
      for (int k = 0; k < steps_per_look; ++k) {
        vehicle::Command command;
        if (stepper_.driven()) {
          command = manoeuvre::control(*setup_.car, plan_, setup_.scenario->road, seen_.grip,
                                       stepper_.car_state(), controller_, sim::Stepper::step);
        }
        stepper_.advance(command);
      }
      if (real()) {
        setup_.clock->wait_until(start_ + from_seconds(stepper_.time()));
      }
    }
    if (thread) {
      thinking_fault = thread->finish();
    }
  }
  if (!thinking_fault.empty()) {
    tell(Plane::thinking, EventKind::fault, "thinking ended: " + thinking_fault);
  }
  conclude();
  return std::move(record_);
}

std::optional<Error> Encounter::look() {
  const Scene scene = stepper_.scene();
  seen_ = stepper_.perceive();
  for (const Scene* const each : {&scene, &std::as_const(seen_)}) {
    if (const auto rule = world::broken_rule(*each)) {
      return Error{Error::Code::out_of_range, setup_.scenario->name + ": at " +
                                                  fmt::format("{:.2f} s", scene.time) +
                                                  ": a scene must hold: " + std::string(*rule)};
    }
  }
  beliefs_ = &observer_.look(seen_);
  if (num_looks_ % looks_per_judgement == 0) {
    note(seen_, *beliefs_, record_.intentions);
  }
  if (!woke_) {
    wake();
  }
  const decide::Reflex reflex = react();
  threatened_ = reflex.threat.has_value() || is_approached(scene);
  if (reflex.triggered) {
    execute(*reflex.threat);
  }
  if (woke_) {
    contact_ = witness_.look(stepper_);
  }
  if (num_looks_ % looks_per_frame == 0 || contact_ || reflex.triggered) {
    film(scene, reflex);
  }
  if (record_.decision && !ended_ &&
      manoeuvre::finished(plan_, stepper_.car_state(), controller_)) {
    ended_ = scene.time;
    tell(Plane::world, EventKind::rest,
         norm(scene.ego.v_B) < 0.1
             ? "the ego is at rest"
             : fmt::format("lane change recovered at {:.1f} m/s", norm(scene.ego.v_B)));
  }
  ++num_looks_;
  return std::nullopt;
}

void Encounter::wake() {
  const Scene& scene = seen_;
  const auto threat =
      preview::previewed_threat(scene, *beliefs_, preview::hard_driving(), setup_.thresholds);
  if (!threat) {
    return;
  }
  woke_ = scene.time;
  stepper_.take_the_wheel();
  controller_ = manoeuvre::begin(*setup_.car, plan_, scene);
  tell(Plane::world, EventKind::preview,
       fmt::format("T2: {} within {:.1f} s of a conflict; SACA drives from here, at {:.1f} m/s",
                   actor_name(scene.actors[threat->actor]), threat->time, norm(scene.ego.v_B)));
}

decide::Reflex Encounter::react() {
  const Scene& scene = seen_;
  if (woke_ && !record_.decision) {
    if (real()) {
      scenes_.publish({scene, *beliefs_, start_ + from_seconds(scene.time)});
    } else {
      charged_.think(plane_, scene, *beliefs_);
    }
  }
  const Clock::Time before = setup_.clock->now();
  hand_over_plans();
  const decide::Reflex reflex = woke_ ? reflex_.step(scene) : decide::Reflex{};
  if (woke_) {
    reflex_times_.push_back(to_seconds(setup_.clock->now() - before));
  }
  return reflex;
}

void Encounter::hand_over_plans() {
  if (!real()) {
    if (const auto plans = charged_.take(stepper_.time())) {
      reflex_.receive(*plans);
    }
    return;
  }
  decide::PlanCache plans;
  if (plans_.take(plans)) {
    reflex_.receive(plans);
  }
}

void Encounter::execute(const preview::Threat& threat) {
  const Scene& scene = seen_;
  decide::Decision decision = *reflex_.decision();
  if (decision.source == decide::Source::forced) {
    decision.plan = manoeuvre::default_plan(decision.plan.policy, norm(scene.ego.v_B));
  }
  const manoeuvre::Plan wanted = decision.plan;
  const auto refused = manoeuvre::refusal(*setup_.car, wanted, scene);
  if (refused) {
    decision.plan = {PolicyId::aeb, std::nullopt};
    decision.source = decide::Source::fallback;
  }
  plan_ = decision.plan;
  controller_ = manoeuvre::begin(*setup_.car, plan_, scene);
  record_.decision = decision;
  record_.at_trigger = stepper_.whole_scene();
  record_.threat = actor_name(scene.actors[threat.actor]);
  seen_at_trigger_ = scene;
  others_at_trigger_ = stepper_.others();
  // The plan stands; now it can be talked about.
  tell(Plane::reflex, EventKind::trigger,
       fmt::format("T1: {:.2f} s to the conflict with {}", threat.time,
                   actor_name(scene.actors[threat.actor])));
  tell(Plane::reflex, EventKind::match, decision_text(*reflex_.decision()));
  if (refused) {
    tell(Plane::reflex, EventKind::fault, policy_text(wanted) + " cannot be driven: " + *refused);
  }
  tell(Plane::reflex, EventKind::execute,
       fmt::format("policy {} ({})", policy_text(plan_), name(decision.source)));
}

void Encounter::film(const Scene& scene, const decide::Reflex& reflex) {
  const Phase phase = record_.decision ? Phase::manoeuvre
                      : woke_          ? Phase::driving
                                       : Phase::recorded;
  std::optional<double> conflict;
  if (reflex.threat) {
    conflict = reflex.threat->time;
  }
  record_.frames.push_back({.phase = phase,
                            .scene = scene,
                            .perceived = seen_,
                            .steering = stepper_.driven() ? stepper_.car_state().steering : 0.0,
                            .conflict = conflict});
}

bool Encounter::over() const {
  return contact_ || stepper_.over() ||
         (ended_ && !threatened_ && stepper_.time() > *ended_ + rest_after_end);
}

void Encounter::conclude() {
  record_.grip = stepper_.grip();
  if (woke_) {
    record_.result = witness_.outcome();
  }
  if (contact_) {
    const auto& cast = witness_.scene().actors;
    record_.met.assign(cast.begin(), cast.end());
    tell(Plane::world, EventKind::contact, outcome::describe(record_.result, record_.met));
  }
  if (record_.decision) {
    Moment trigger{*record_.at_trigger, others_at_trigger_, stepper_.grip(),
                   stepper_.unknown_from_now(), record_.decision->plan};
    trigger.scene.grip = seen_at_trigger_.grip;
    record_.hindsight = hindsight(trigger, *setup_.car, *setup_.harm);
    std::array<preview::PolicyFacts, manoeuvre::num_policies> facts;
    std::transform(record_.hindsight->begin(), record_.hindsight->end(), facts.begin(),
                   [](const Hindsight& one) { return one.facts; });
    record_.best = preview::best_by_forecast(facts);
  }
  compare_with_driver();
  {
    const std::lock_guard guard(thinking_events_lock_);
    record_.events.insert(record_.events.end(), thinking_events_.begin(), thinking_events_.end());
  }
  std::stable_sort(record_.events.begin(), record_.events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  record_.previews = plane_.previews();
  record_.deadline_misses = plane_.deadline_misses();
  if (setup_.danger != nullptr) {
    record_.danger_maps = danger_maps(record_, *setup_.danger);
  }
  if (!reflex_times_.empty()) {
    std::sort(reflex_times_.begin(), reflex_times_.end());
    record_.reflex = {reflex_times_.size(), reflex_times_[reflex_times_.size() / 2],
                      reflex_times_.back()};
  }
  learn();
}

/// The recorded driver's own way through the same scene, from where SACA took the wheel.
void Encounter::compare_with_driver() {
  if (!woke_ || !std::holds_alternative<sim::Recording>(setup_.scenario->ego)) {
    return;
  }
  double recorded_until = std::get<sim::Recording>(setup_.scenario->ego).back().time;
  for (const sim::ScenarioActor& actor : setup_.scenario->actors) {
    const auto* const recording = std::get_if<sim::Recording>(&actor.motion);
    if (recording != nullptr && recording->back().time > *woke_) {
      recorded_until = std::min(recorded_until, recording->back().time);  // beyond, it is a guess
    }
  }
  constexpr double worth_a_look = 0.1;  // [s]
  if (recorded_until < *woke_ + worth_a_look) {
    return;
  }
  sim::Stepper replay(*setup_.scenario, *setup_.car);
  Witness witness(*setup_.harm);
  while (!replay.over() && replay.time() <= recorded_until) {
    if (replay.time() >= *woke_) {
      if (witness.look(replay)) {
        const auto& cast = witness.scene().actors;
        record_.met_by_driver.assign(cast.begin(), cast.end());
        break;
      }
    }
    for (int k = 0; k < steps_per_look; ++k) {
      replay.advance({});
    }
  }
  record_.driver = witness.outcome();
}

void Encounter::learn() {
  if (setup_.memory == nullptr || !record_.decision) {
    return;
  }
  const preview::PolicyFacts& best = (*record_.hindsight)[manoeuvre::index(*record_.best)].facts;
  const memory::Case learnt{
      .scene = seen_at_trigger_,
      .plan = record_.decision->plan,
      .best = *record_.best,
      .harm = record_.result.harm,
      .best_harm = best.outcome.harm,
      .collision_loss = record_.result.collision_loss,
      .review = fmt::format("{}: {}; best {}: {}", name(record_.decision->plan.policy),
                            outcome::describe(record_.result, record_.met), name(*record_.best),
                            outcome::describe(best.outcome, *record_.at_trigger)),
      .source = setup_.scenario->name};
  const auto id = setup_.memory->add(learnt);
  if (id.has_value()) {
    record_.stored = id.value();
    tell(Plane::thinking, EventKind::memory, fmt::format("stored as case {}", id.value()));
  } else {
    record_.not_stored = id.error();
    tell(Plane::thinking, EventKind::fault, "memory: " + id.error().message);
  }
}

}  // namespace

std::string_view name(Pace pace) {
  return name_of(pace, pace_names);
}

std::string_view name(Phase phase) {
  return name_of(phase, phase_names);
}

std::string decision_text(const decide::Decision& decision) {
  using decide::Source;
  if (decision.source == Source::forced) {
    return "asked for by the user";
  }
  if (!decision.similarity) {
    return "no plan is cached: emergency braking";
  }
  std::string text = fmt::format("the scene is {:.0f} % like forecast {}",
                                 100.0 * *decision.similarity, *decision.preview + 1);
  if (decision.source != Source::fallback) {
    return text + fmt::format(": its plan, from {}, is taken", name(decision.source));
  }
  if (!decision.gave_way_to_aeb) {
    return text + ", not more than 90 %: emergency braking";
  }
  return text +
         (decision.forecast
              ? fmt::format(", whose plan would do more harm from here than emergency braking: "
                            "{:.4f} against {:.4f}",
                            decision.forecast->plan, decision.forecast->aeb)
              : ", whose plan is now forecast to be no better than emergency braking");
}

Result<Record> run(const Setup& setup, Listener& listener) {
  expects(setup.scenario != nullptr && setup.car != nullptr && setup.harm != nullptr &&
              setup.intent != nullptr && setup.clock != nullptr,
          "scenario, car, harm, intent and clock are given");
  return Encounter(setup, listener).play();
}

}  // namespace saca::loop
