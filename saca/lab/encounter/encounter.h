#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/encounter/danger_map.h"
#include "saca/lab/encounter/hindsight.h"
#include "saca/lab/encounter/intentions_seen.h"
#include "saca/lab/encounter/listener.h"
#include "saca/lab/encounter/verdict_log.h"
#include "saca/lab/scenario/scenario.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/runtime/planes.h"
#include "saca/runtime/tape_json.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/intent/model.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/review.h"
#include "saca/thinking/memory/store.h"

namespace saca::encounter {

/// Everything that an encounter is run with. What it points to outlives the run.
struct Setup {
  const scenario::Scenario* scenario = nullptr;
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  const intent::Model* intent = nullptr;
  const atlas::Atlas* atlas = nullptr;  ///< of the car; nullptr: all forecasts are rolled out
  const danger::DangerModel* danger = nullptr;  ///< of the car; nullptr: the best of few evasions
  const intent::CueLaw* cues = nullptr;  ///< what cues of a scene stand for; nullptr: nothing
  reflex::Thresholds thresholds;
  runtime::Pace pace = runtime::Pace::lockstep;
  runtime::ThinkingCosts costs;                    ///< for lockstep
  language_model::LanguageModel* model = nullptr;  ///< nullptr: without; deadlines on `clock`
  memory::Store* memory = nullptr;                 ///< nullptr: without
  bool learns = true;                              ///< what happened is added to memory in the end
  reflex::Guard guard = reflex::Guard::never_worse_than_braking;
  std::optional<manoeuvre::Plan> forced;  ///< carried out at the trigger, whatever was thought; 3
                                          ///< and 4 brake to half of the speed then
  std::optional<std::uint64_t> seed;      ///< of what is left to chance; nullopt: nothing is
  bool tapes = false;                     ///< `Record::tape` is wanted
  Clock* clock = nullptr;                 ///< real time
};

enum class Phase : std::uint8_t { recorded, driving, manoeuvre };
[[nodiscard]] std::string_view name(Phase phase);

/// One picture of the film, every 20 ms.
struct Frame {
  Phase phase = Phase::recorded;
  world::Scene scene;              ///< the truth
  world::Scene perceived;          ///< what SACA was shown
  double steering = 0.0;           ///< of the road wheels [rad]
  std::optional<double> conflict;  ///< time to conflict [s]
};

/// What was begun after the trigger in place of another plan.
struct TimedSwitch {
  double time = 0.0;  ///< [s]
  reflex::Switch change;
};

/// One encounter from start to rest, with everything that led there.
struct Record {
  double grip = 0.0;  ///< true friction coefficient of the road [-]
  std::vector<Frame> frames;
  std::vector<IntentionsSeen> intentions;  ///< one per road user, in the order of first sight
  std::vector<arbitration::Event> events;  ///< by time
  std::vector<arbitration::Preview> previews;
  std::optional<reflex::Decision> decision;
  std::vector<TimedSwitch> switches;       ///< after it
  VerdictLog verdicts;                     ///< that the reflex plane had in hand
  std::optional<world::Scene> at_trigger;  ///< the truth
  std::optional<std::string> threat;       ///< the actor that set off the trigger
  collision::Outcome result;
  std::vector<world::Actor> met;        ///< the actors that the result counts in
  std::optional<Hindsights> hindsight;  ///< if triggered
  std::optional<manoeuvre::PolicyId> best;
  std::optional<DangerMaps> danger_maps;         ///< by `Setup::danger`
  std::optional<collision::Outcome> driver;      ///< what the recorded driver's own motion led to
  std::vector<world::Actor> met_by_driver;       ///< the actors that `driver` counts in
  std::optional<match::CaseId> stored;           ///< the case that memory learnt
  std::optional<Error> not_stored;               ///< why memory could not learn it
  std::optional<language_model::Review> review;  ///< see encounter/review.h
  std::optional<runtime::TapeFile> tape;         ///< its program is left empty
  runtime::PlanesTiming timing;
  int deadline_misses = 0;
};

/// Plays the encounter. The ego follows what the scenario gives until something threatens within
/// T2; from there SACA drives.
///
/// At pace `real` nothing waits for the listener while the encounter lasts; in the end this returns
/// when the listener has heard everything, so a listener that must not hold that up comes back by
/// itself. What the listener throws is thrown again.
/// @return  Error::Code::out_of_range when the scenario cannot be played with this car
[[nodiscard]] Result<Record> run(const Setup& setup, Listener& listener);

struct Provenance;

/// The record as one JSON document, schema saca.record/1 of docs/formats.md.
/// @param provenance  nullptr: it does not say who made it
[[nodiscard]] std::string record_json(const Setup& setup, const Record& record,
                                      const Provenance* provenance = nullptr);

}  // namespace saca::encounter
