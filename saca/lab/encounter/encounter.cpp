#include "saca/lab/encounter/encounter.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "saca/base/core/names.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/encounter/dispatcher.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/encounter/recorded_driver.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/runtime/avoider.h"
#include "saca/thinking/preview/preview.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::encounter {
namespace {

using arbitration::Event;
using arbitration::EventKind;
using arbitration::Plane;
using world::Scene;

constexpr std::array<std::string_view, 3> phase_names{"recorded", "driving", "manoeuvre"};

constexpr int looks_per_frame = 2;            // 50 Hz
constexpr std::uint32_t first_encounter = 1;  // of the avoider: its first step begins it
constexpr int looks_per_judgement = 10;       // 10 Hz, as intent::Observer judges

/// One encounter under way.
class Encounter {
 public:
  Encounter(const Setup& setup, Listener& listener)
      : setup_(setup),
        listener_(listener),
        stage_(stage_of(setup)),
        loop_(stage_),
        dispatcher_(real() ? std::make_unique<Dispatcher>(listener) : nullptr),
        avoider_({.planes = planes_setup(setup),
                  .intent = setup.intent,
                  .thinking = thinking_listener(),
                  .num_timed = num_looks(*setup.scenario)}) {}

  Result<Record> play();

 private:
  [[nodiscard]] bool real() const { return setup_.pace == runtime::Pace::real; }
  /// How many there are at most.
  static std::size_t num_looks(const scenario::Scenario& scenario) {
    return static_cast<std::size_t>(scenario.duration / ClosedLoop::step) + 2;
  }
  static Stage stage_of(const Setup& setup);
  static runtime::PlanesSetup planes_setup(const Setup& setup);

  [[nodiscard]] runtime::Planes::Listener thinking_listener();
  void tell(Event event);
  void tell(Plane plane, EventKind kind, std::string text) {
    tell({loop_.time(), plane, kind, std::move(text)});
  }
  [[nodiscard]] std::optional<Error> look();
  void wake();
  void note(const Answer& answer, std::uint32_t encounter);
  void note_decision(const Answer& answer);
  void film(const Answer& answer);
  void conclude();
  void take_over_thoughts();
  void compare_with_driver();
  void learn();

  const Setup& setup_;
  Listener& listener_;
  Stage stage_;
  ClosedLoop loop_;
  std::unique_ptr<Dispatcher> dispatcher_;  ///< at pace `real`; lives longer than who hands over
  /// What the thinking plane thought in one encounter of the avoider.
  struct Thoughts {
    std::vector<arbitration::Preview> previews;
    std::vector<Event> events;
    int deadline_misses = 0;
  };
  std::map<std::uint32_t, Thoughts> thoughts_;  ///< of the thread that thinks, until that has ended
  Avoider avoider_;
  Record record_;
  Clock::Time start_{0};
  int looks_ = 0;
  std::optional<double> woke_;              ///< when SACA took the wheel [s]
  std::optional<std::uint32_t> encounter_;  ///< the avoider's, in which the decision was made
  std::uint32_t judged_ = first_encounter;  ///< the one that the record's verdicts are of
  bool ended_ = false;                      ///< the manoeuvre is finished
  std::optional<Trigger> trigger_;
};

Stage Encounter::stage_of(const Setup& setup) {
  return {.scenario = setup.scenario,
          .car = setup.car,
          .harm = setup.harm,
          .intent = setup.intent,
          .thresholds = setup.thresholds,
          .chance = setup.seed ? scenario::draw_chance(*setup.seed, 0, 0.0) : scenario::Chance{}};
}

runtime::PlanesSetup Encounter::planes_setup(const Setup& setup) {
  return {.forecast = {.car = setup.car,
                       .harm = setup.harm,
                       .atlas = setup.atlas,
                       .danger = setup.danger,
                       .cues = setup.cues},
          .thresholds = setup.thresholds,
          .pace = setup.pace,
          .costs = setup.costs,
          .model = setup.model,
          .memory = setup.memory,
          .guard = setup.guard,
          .forced = setup.forced,  // a target speed is set at the trigger
          .clock = setup.clock,
          .tape_size = setup.tapes ? num_looks(*setup.scenario) *
                                         runtime::Tape::step_size(setup.scenario->actors.size())
                                   : 0};
}

runtime::Planes::Listener Encounter::thinking_listener() {
  return {.event =
              [this](const Event& event) {
                real() ? dispatcher_->event(Dispatcher::Producer::thinking, event)
                       : listener_.on_event(event);
              },
          .reasoning =
              [this](std::int32_t preview, std::string_view text) {
                real() ? dispatcher_->reasoning(preview, std::string(text))
                       : listener_.on_reasoning(preview, text);
              },
          .thought =
              [this](std::uint32_t encounter, const std::vector<arbitration::Preview>& previews,
                     const std::vector<Event>& events, int deadline_misses) {
                thoughts_[encounter] = {previews, events, deadline_misses};
              }};
}

void Encounter::tell(Event event) {
  if (real()) {
    dispatcher_->event(Dispatcher::Producer::driving, event);
  } else {
    listener_.on_event(event);
  }
  record_.events.push_back(std::move(event));
}

Result<Record> Encounter::play() {
  start_ = setup_.clock->now();
  while (!loop_.over()) {
    if (const auto problem = look()) {
      return *problem;
    }
    loop_.advance(avoider_);
    if (real()) {
      setup_.clock->wait_until(start_ + from_seconds(loop_.time()));
    }
  }
  const std::string fault = avoider_.finish();
  if (!fault.empty()) {
    tell(Plane::thinking, EventKind::fault, "an exception ended a round of the " + fault);
  }
  conclude();
  if (real()) {
    dispatcher_->finish();
  }
  return std::move(record_);
}

std::optional<Error> Encounter::look() {
  if (auto problem = loop_.look()) {
    return problem;
  }
  wake();
  const std::uint32_t encounter = std::max(first_encounter, avoider_.planes().encounter());
  const Answer answer = avoider_.step(loop_.seen(), start_ + from_seconds(loop_.time()));
  if (looks_ % looks_per_judgement == 0) {
    encounter::note(avoider_.scene(), avoider_.beliefs(), record_.intentions);
  }
  note(answer, encounter);
  loop_.keep();
  if (looks_ % looks_per_frame == 0 || loop_.contact() || answer.triggered) {
    film(answer);
  }
  if (record_.decision && !ended_ && avoider_.finished()) {
    ended_ = true;
    const double speed = norm(loop_.truth().ego().v_B);
    tell(Plane::world, EventKind::rest,
         speed < 0.1 ? "the ego is at rest"
                     : fmt::format("lane change recovered at {:.1f} m/s", speed));
  }
  ++looks_;
  return std::nullopt;
}

void Encounter::wake() {
  const auto threat = loop_.wake();
  if (!threat) {
    return;
  }
  const Scene& scene = loop_.seen();
  woke_ = scene.time;
  tell(Plane::world, EventKind::preview,
       fmt::format("T2: {} within {:.1f} s of a conflict; SACA drives from here, at {:.1f} m/s",
                   actor_name(scene.actors[threat->actor]), threat->time, norm(scene.ego.v_B)));
}

/// What the avoider decided, and by what. Of one encounter: what follows it is told.
/// @param encounter  that was under way when it was asked
void Encounter::note(const Answer& answer, std::uint32_t encounter) {
  while (auto event = avoider_.next_event()) {
    tell(*std::move(event));
  }
  ended_ = ended_ && !answer.begins;
  if (encounter_ && *encounter_ != encounter) {
    return;
  }
  if (!encounter_ && encounter != judged_) {  // another, and in none was anything decided
    judged_ = encounter;
    record_.verdicts = {};
  }
  const auto& got = avoider_.planes().new_verdict();
  record_.verdicts.note(avoider_.scene(), avoider_.beliefs(),
                        got ? std::optional(got->verdict) : std::nullopt);
  if (answer.triggered) {
    note_decision(answer);
  } else if (answer.switched) {
    record_.verdicts.note(*answer.switched);
    record_.switches.push_back({loop_.time(), *answer.switched});
  }
}

void Encounter::note_decision(const Answer& answer) {
  const Scene& scene = avoider_.scene();
  const reflex::Decision& decision = *avoider_.decision();
  encounter_ = avoider_.planes().encounter();
  woke_ = woke_.value_or(scene.time);
  record_.decision = decision;
  record_.verdicts.note(decision);
  record_.at_trigger = loop_.truth().whole_scene();
  record_.threat = actor_name(scene.actors[answer.threat->actor]);
  trigger_ = {.seen = scene,
              .beliefs = avoider_.beliefs(),
              .point = {*record_.at_trigger, loop_.truth().others(), loop_.truth().grip(),
                        loop_.truth().perturbation_from_now(), decision.plan}};
  trigger_->point.scene.grip = scene.grip;
}

void Encounter::film(const Answer& answer) {
  const Phase phase = record_.decision ? Phase::manoeuvre
                      : woke_          ? Phase::driving
                                       : Phase::recorded;
  std::optional<double> conflict;
  if (answer.threat) {
    conflict = answer.threat->time;
  }
  record_.frames.push_back({.phase = phase,
                            .scene = loop_.truth().scene(),
                            .perceived = loop_.seen(),
                            .steering = loop_.steering(),
                            .conflict = conflict});
}

void Encounter::conclude() {
  record_.grip = loop_.truth().grip();
  if (const auto outcome = loop_.outcome()) {
    record_.result = *outcome;
  }
  const auto& cast = loop_.met().actors;
  record_.met.assign(cast.begin(), cast.end());
  if (record_.decision && !record_.result.contact) {
    // As hindsight does: what was near before something was decided is nothing that it led to.
    const collision::Outcome since = loop_.outcome_since(record_.decision->time);
    record_.result.clearance = since.clearance;
    record_.result.nearest = since.nearest;
  }
  if (loop_.contact()) {
    tell(Plane::world, EventKind::contact, rollout::describe(record_.result, record_.met));
  }
  if (record_.decision) {
    record_.hindsight = hindsight_of_all_speeds(trigger_->point, *setup_.car, *setup_.harm);
    preview::AllFacts facts;
    std::transform(record_.hindsight->begin(), record_.hindsight->end(), facts.begin(),
                   [](const Hindsight& one) { return one.facts; });
    record_.best = preview::best_by_forecast(facts);
  }
  compare_with_driver();
  take_over_thoughts();
  if (setup_.danger != nullptr) {
    record_.danger_maps = danger_maps(record_, *setup_.danger);
  }
  record_.timing = avoider_.planes().timing();
  if (setup_.tapes) {
    runtime::TapeHeader header = runtime::tape_header(planes_setup(setup_), *setup_.intent);
    header.car = setup_.scenario->car;
    header.scenario = setup_.scenario->name;
    header.seed = setup_.seed;
    record_.tape = {header, avoider_.tape().content()};
  }
  learn();
}

/// All events, and the previews of the encounter in which it was decided; of the last one where
/// nothing was.
void Encounter::take_over_thoughts() {
  for (auto& [encounter, thoughts] : thoughts_) {
    record_.events.insert(record_.events.end(), thoughts.events.begin(), thoughts.events.end());
    if (!encounter_ || encounter == *encounter_) {
      record_.previews = std::move(thoughts.previews);
      record_.deadline_misses = thoughts.deadline_misses;
    }
  }
  std::stable_sort(record_.events.begin(), record_.events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
}

/// The recorded driver's own way through the same scene, from where SACA took the wheel.
void Encounter::compare_with_driver() {
  if (!woke_) {
    return;
  }
  if (auto driver = recorded_driver(*setup_.scenario, *setup_.car, *setup_.harm, *woke_)) {
    record_.driver = driver->outcome;
    record_.met_by_driver = std::move(driver->met);
  }
}

std::string learnt_text(const memory::LearningResult& learnt,
                        const std::optional<match::CaseId>& refuted) {
  using How = memory::LearningResult::How;
  const std::string doubt = refuted ? fmt::format("; case {} is asked no more", *refuted) : "";
  switch (learnt.how) {
    case How::added:
      break;
    case How::merged:
      return fmt::format("merged into case {}", learnt.id) + doubt;
    case How::contradicted:
      return fmt::format("stored as case {}, which contradicts case {}", learnt.id, learnt.other) +
             doubt;
  }
  return fmt::format("stored as case {}", learnt.id) + doubt;
}

void Encounter::learn() {
  if (setup_.memory == nullptr || !setup_.learns || !record_.decision) {
    return;
  }
  const auto refuted = refuted_case(record_);
  const auto learnt =
      encounter::learn(*setup_.memory, learnt_case(setup_, record_, *trigger_), refuted);
  if (learnt.has_value()) {
    record_.stored = learnt.value().id;
    tell(Plane::thinking, EventKind::memory, learnt_text(learnt.value(), refuted));
  } else {
    record_.not_stored = learnt.error();
    tell(Plane::thinking, EventKind::fault, "memory: " + learnt.error().message);
  }
}

}  // namespace

std::string_view name(Phase phase) {
  return name_of(phase, phase_names);
}

Result<Record> run(const Setup& setup, Listener& listener) {
  expects(setup.scenario != nullptr && setup.car != nullptr && setup.harm != nullptr &&
              setup.intent != nullptr && setup.clock != nullptr,
          "scenario, car, harm, intent and clock are given");
  return Encounter(setup, listener).play();
}

}  // namespace saca::encounter
