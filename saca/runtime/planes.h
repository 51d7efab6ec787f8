#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/latest_slot.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/runtime/charged_forecasts.h"
#include "saca/runtime/charged_model.h"
#include "saca/runtime/charged_thinking.h"
#include "saca/runtime/tape.h"
#include "saca/runtime/work_thread.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/arbitration/thinking_plane.h"

namespace saca::runtime {

/// How simulated and real time go together.
enum class Pace : std::uint8_t {
  real,      ///< the world goes on at wall-clock speed while SACA thinks
  lockstep,  ///< the world waits; thinking is charged to simulated time: fast and repeatable
};
[[nodiscard]] std::string_view name(Pace pace);

/// What both planes are made of. What it points to outlives them.
struct PlanesSetup {
  preview::ForecastTools forecast;
  reflex::Thresholds thresholds;
  Pace pace = Pace::lockstep;
  ThinkingCosts costs;                             ///< for lockstep
  language_model::LanguageModel* model = nullptr;  ///< nullptr: without; deadlines on `clock`
  memory::Store* memory = nullptr;                 ///< nullptr: without
  reflex::Guard guard = reflex::Guard::never_worse_than_braking;
  arbitration::Asking asking;
  arbitration::Judge judge;  ///< makes the verdicts, on a thread of its own at pace `real`; empty:
                             ///< a arbitration::Forecaster
  std::optional<manoeuvre::Plan> forced;  ///< carried out at the trigger, whatever was thought
  Clock* clock = nullptr;                 ///< real time; not null, at either pace
  std::size_t tape_size = 0;              ///< memory of the tape [byte], see Tape; 0: no tape
  std::size_t most_events = 4096;         ///< of the thinking plane, kept of one encounter, >= 2
};

/// What the reflex plane of this setup decides with.
[[nodiscard]] reflex::ReflexTools reflex_tools(const PlanesSetup& setup);

/// How long the planes took.
struct PlanesTiming {
  std::size_t calls = 0;  ///< of the reflex plane
  double p50 = 0.0;       ///< of them [s]
  double max = 0.0;       ///< likewise [s]
  double sum = 0.0;       ///< likewise [s]
  /// Processor time of the thinking plane's thread and of the forecaster's [s]; nullopt in
  /// lockstep.
  std::optional<double> thinking;
  std::optional<double> forecasting;
};

/// SACA: its reflex plane, its forecaster and its thinking plane, joined at either pace;
/// encounters one after the other.
class Planes {
 public:
  struct Listener {
    std::function<void(const arbitration::Event&)> event = [](const arbitration::Event&) {};
    std::function<void(std::int32_t preview, std::string_view text)> reasoning =
        [](std::int32_t, std::string_view) {};
    /// What was thought in one encounter, and the events of it (`thinking_events`), before it is
    /// forgotten; of the last one in `finish`.
    /// `deadline_misses`: how often the model gave no answer in time
    std::function<void(std::uint32_t encounter, const std::vector<arbitration::Preview>&,
                       const std::vector<arbitration::Event>&, int deadline_misses)>
        thought = [](std::uint32_t, const std::vector<arbitration::Preview>&,
                     const std::vector<arbitration::Event>&, int) {};
  };

  /// @param listener  hears the thinking plane; at pace `real` on its thread, which waits for it
  /// @param looks     how often `step` will be called at most
  Planes(const PlanesSetup& setup, Listener listener, std::size_t looks);
  Planes(const Planes&) = delete;
  Planes& operator=(const Planes&) = delete;
  ~Planes() = default;

  /// One instant. While nobody threatens within T2, nothing is forecast and nothing thought about.
  /// @param beliefs  one per actor of the scene
  /// @param at       when, on the clock, the scene was true; of no account in lockstep
  /// @param finished  what is carried out has reached its safe end
  reflex::Reflex step(const world::Scene& scene, const intent::Beliefs& beliefs, Clock::Time at,
                      bool finished);

  [[nodiscard]] const std::optional<reflex::Decision>& decision() const {
    return reflex_.decision();
  }

  /// What the forecaster had ready for the reflex plane in the newest step; nullopt: nothing.
  [[nodiscard]] const std::optional<NumberedVerdict>& new_verdict() const {
    return entry_->verdict;
  }

  /// The encounter is over: decision, plans and previews are forgotten, those of the thinking plane
  /// at its next scene. Waits for nobody.
  /// @param forgotten  whether the drive is over, too: who observes the road users begins anew, and
  ///                   time jumps
  void begin_anew(Reset forgotten = Reset::encounter);

  /// The encounter under way, counted.
  [[nodiscard]] std::uint32_t encounter() const { return encounter_; }

  /// Belongs to the thread that calls `step`.
  [[nodiscard]] const Tape& tape() const { return tape_; }

  /// Ends thinking and forecasting; `step` is not called any more.
  /// @return  what was thrown there first; it ended that round early. Empty: nothing was
  std::string finish();

  // Once finished, or in lockstep:
  /// Of this encounter; where there were more than `most_events`, the newer ones, and first how
  /// many are left out.
  [[nodiscard]] const std::vector<arbitration::Event>& thinking_events() const { return events_; }
  [[nodiscard]] const std::vector<arbitration::Preview>& previews() const {
    return plane_.previews();
  }
  /// Processor times once finished.
  [[nodiscard]] PlanesTiming timing() const;

 private:
  [[nodiscard]] bool real() const { return setup_.pace == Pace::real; }
  [[nodiscard]] arbitration::ThinkingTools tools();
  [[nodiscard]] arbitration::ThinkingOutput output();
  void begin_entry(const world::Scene& scene, const intent::Beliefs& beliefs);
  void hand_over(const world::Scene& scene, bool finished);
  void think_of(std::uint32_t encounter);
  void think(const TimedScene& newest, const std::stop_token& stop);
  void hand_over_thoughts();
  void keep(const arbitration::Event& event);
  /// Does somebody threaten within T2, or is a plan under way?
  [[nodiscard]] bool is_to_be_judged(const TimedScene& newest) const;
  void judge(const TimedScene& newest);

  PlanesSetup setup_;
  Listener listener_;
  ManualClock simulated_clock_;
  std::unique_ptr<ChargedModel> charged_model_;
  ChargedThinking charged_;
  ChargedForecasts charged_forecasts_;
  reflex::ReflexPlane reflex_;
  LatestSlot<TimedScene> scenes_;
  LatestSlot<TimedScene> scenes_to_judge_;
  LatestSlot<NumberedVerdict> verdicts_;
  /// Plans, and for which encounter they were thought of.
  struct NumberedPlans {
    reflex::PlanCache plans;
    std::uint32_t encounter = 0;
  };
  LatestSlot<NumberedPlans> plans_;
  NumberedPlans newest_plans_;
  std::vector<arbitration::Event> events_;
  std::size_t events_left_out_ = 0;
  std::vector<double> reflex_times_;  ///< of the first `looks` steps
  Tape tape_;
  std::unique_ptr<TapeStep> entry_ = std::make_unique<TapeStep>();  ///< the newest
  std::uint64_t num_scenes_ = 0;
  Reset forgotten_ = Reset::drive;  ///< before the next step
  std::uint32_t encounter_ = 0;
  std::uint64_t first_scene_ = 0;  ///< of the encounter under way
  bool threatened_ = false;        ///< somebody has, in this encounter; in lockstep
  std::uint32_t thought_of_ = 0;   ///< the encounter that the thinking plane was last asked about;
                                   ///< of the thread that thinks
  std::unique_ptr<TimedScene> newer_ = std::make_unique<TimedScene>();  ///< of the same thread
  arbitration::ThinkingPlane plane_;
  std::unique_ptr<WorkThread> thinking_;     ///< at pace `real`
  std::unique_ptr<WorkThread> forecasting_;  ///< likewise
};

}  // namespace saca::runtime
