#include "saca/runtime/planes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "saca/base/core/names.h"
#include "saca/thinking/preview/previewed_threat.h"

namespace saca::runtime {
namespace {

constexpr std::array<std::string_view, 2> pace_names{"real", "lockstep"};

constexpr Clock::Time breath = std::chrono::milliseconds(200);  // plans change slowly

PlanesSetup with_judge(PlanesSetup setup) {
  if (!setup.judge) {
    setup.judge = arbitration::judge_with(setup.forecast);
  }
  return setup;
}

}  // namespace

std::string_view name(Pace pace) {
  return name_of(pace, pace_names);
}

reflex::ReflexTools reflex_tools(const PlanesSetup& setup) {
  const preview::ForecastTools& forecast = setup.forecast;
  reflex::ReflexTools tools{.thresholds = setup.thresholds,
                            .car = forecast.car,
                            .atlas = {},
                            .forced = setup.forced,
                            .guard = setup.guard};
  if (forecast.atlas != nullptr) {
    tools.atlas.emplace(*forecast.car, *forecast.atlas, *forecast.harm, forecast.braking);
  }
  return tools;
}

Planes::Planes(const PlanesSetup& setup, Listener listener, std::size_t looks)
    : setup_(with_judge(setup)),
      listener_(std::move(listener)),
      charged_model_(setup.model == nullptr
                         ? nullptr
                         : std::make_unique<ChargedModel>(*setup.model, setup.costs, *setup.clock,
                                                          simulated_clock_)),
      charged_(setup.costs.preview, simulated_clock_),
      charged_forecasts_(
          setup_.judge,
          [cost = setup.costs.verdict, cues = setup.forecast.cues](const TimedScene& one) {
            return cost * arbitration::judgements_of(one.scene, one.beliefs, cues);
          }),
      reflex_(reflex_tools(setup)),
      tape_(setup.tape_size),
      plane_(tools(), setup.thresholds, output()) {
  reflex_times_.reserve(looks);
  if (real()) {
    thinking_ = std::make_unique<WorkThread>(
        scenes_, *setup_.clock, breath,
        [this](const TimedScene& newest, const std::stop_token& stop) { think(newest, stop); });
  }
  if (real() && reflex_.supervises()) {
    forecasting_ = std::make_unique<WorkThread>(
        scenes_to_judge_, *setup_.clock, from_seconds(0.5 * verdict_period),
        [this](const TimedScene& newest, const std::stop_token&) { judge(newest); });
  }
}

arbitration::ThinkingTools Planes::tools() {
  arbitration::ThinkingTools tools{.forecast = setup_.forecast,
                                   .memory = setup_.memory,
                                   .model = setup_.model,
                                   .clock = setup_.clock,
                                   .guard = setup_.guard,
                                   .asking = setup_.asking};
  if (!real()) {
    tools.model = charged_model_.get();
    tools.clock = &simulated_clock_;
  }
  return tools;
}

arbitration::ThinkingOutput Planes::output() {
  return {.publish =
              [this](const reflex::PlanCache& plans, double ready) {
                real() ? plans_.publish({plans, thought_of_}) : charged_.publish(plans, ready);
              },
          .event =
              [this](const arbitration::Event& event) {
                if (!real()) {
                  charged_.busy_until(event.time);
                }
                keep(event);
                listener_.event(event);
              },
          .reasoning = [this](std::int32_t preview,
                              std::string_view text) { listener_.reasoning(preview, text); }};
}

void Planes::begin_entry(const world::Scene& scene, const intent::Beliefs& beliefs) {
  entry_->number = num_scenes_++;
  entry_->forgotten = std::exchange(forgotten_, Reset::nothing);
  if (tape_.records()) {
    entry_->scene = scene;
    entry_->beliefs = beliefs;
  }
  entry_->finished = false;
  entry_->plans.reset();
  entry_->verdict.reset();
  entry_->reflex = {};
  entry_->decision.reset();
}

reflex::Reflex Planes::step(const world::Scene& scene, const intent::Beliefs& beliefs,
                            Clock::Time at, bool finished) {
  begin_entry(scene, beliefs);
  const bool judges = reflex_.supervises();
  const TimedScene newest{scene, beliefs, at, reflex_.under_way(), encounter_, entry_->number};
  if (real()) {
    if (judges) {
      scenes_to_judge_.publish(newest);
    }
    if (!decision()) {
      scenes_.publish(newest);
    }
  } else {
    // From the first threat on, so that the rounds of an encounter do not depend on what was
    // before.
    threatened_ = threatened_ || is_to_be_judged(newest);
    if (judges && threatened_ && !world::broken_rule(scene)) {
      charged_forecasts_.offer(newest);
    }
    if (!decision()) {
      think_of(encounter_);
      charged_.think(plane_, scene, beliefs);
    }
  }
  const Clock::Time before = setup_.clock->now();
  hand_over(scene, finished);
  const reflex::Reflex reflex = reflex_.step(scene, finished);
  if (reflex_times_.size() < reflex_times_.capacity()) {
    reflex_times_.push_back(to_seconds(setup_.clock->now() - before));
  }
  entry_->finished = finished;
  entry_->reflex = reflex;
  if (reflex.triggered) {
    entry_->decision = decision();
  }
  tape_.add(*entry_);
  return reflex;
}

void Planes::hand_over(const world::Scene& scene, bool finished) {
  if (!real()) {
    entry_->plans = charged_.take(scene.time);
    if (reflex_.needs_verdict(scene, finished)) {
      entry_->verdict = charged_forecasts_.take(scene.time);
    }
  } else {
    if (plans_.take(newest_plans_) && newest_plans_.encounter == encounter_) {
      entry_->plans = newest_plans_.plans;
    }
    if (!verdicts_.take(entry_->verdict.emplace()) || entry_->verdict->scene < first_scene_) {
      entry_->verdict.reset();
    }
  }
  if (entry_->plans) {
    reflex_.receive(*entry_->plans);
  }
  if (entry_->verdict) {
    reflex_.receive(entry_->verdict->verdict);
  }
}

void Planes::begin_anew(Reset forgotten) {
  forgotten_ = std::max(forgotten_, forgotten);
  ++encounter_;
  first_scene_ = num_scenes_;
  threatened_ = false;
  reflex_.begin_anew();
  if (real()) {
    return;  // nothing is charged, and the thinking plane's thread forgets by itself
  }
  if (forgotten == Reset::drive) {
    charged_forecasts_.begin_anew();
    charged_.begin_anew();
  } else {
    charged_forecasts_.forget();
  }
}

bool Planes::is_to_be_judged(const TimedScene& newest) const {
  return !world::broken_rule(newest.scene) &&
         (newest.under_way || reflex::measured_threat(newest.scene, setup_.thresholds) ||
          preview::previewed_threat(newest.scene, newest.beliefs, setup_.forecast.motion,
                                    setup_.thresholds));
}

void Planes::judge(const TimedScene& newest) {
  if (is_to_be_judged(newest)) {
    verdicts_.publish(
        {setup_.judge(newest.scene, newest.beliefs, newest.under_way), newest.number});
  }
}

void Planes::think(const TimedScene& newest, const std::stop_token& stop) {
  think_of(newest.encounter);
  const auto newer = [&]() -> std::optional<arbitration::NewerScene> {
    if (!scenes_.take(*newer_)) {
      return std::nullopt;
    }
    return arbitration::NewerScene{newer_->scene, newer_->beliefs,
                                   newer_->encounter != newest.encounter};
  };
  plane_.think(newest.scene, newest.beliefs, newest.at, stop, newer);
}

void Planes::think_of(std::uint32_t encounter) {
  if (thought_of_ != encounter) {
    hand_over_thoughts();
    thought_of_ = encounter;
    plane_.forget();
    if (!real()) {
      charged_.forget();
    }
    events_.clear();
    events_left_out_ = 0;
  }
}

void Planes::hand_over_thoughts() {
  if (!plane_.previews().empty() || !events_.empty()) {
    listener_.thought(thought_of_, plane_.previews(), events_, plane_.deadline_misses());
  }
}

void Planes::keep(const arbitration::Event& event) {
  if (events_.size() >= setup_.most_events) {
    const std::size_t before = events_left_out_ == 0 ? 0 : 1;  // that which says so
    const std::size_t dropped = std::max<std::size_t>(2, events_.size() / 2);
    events_left_out_ += dropped - before;
    events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(dropped) - 1);
    events_.front() = {
        event.time, arbitration::Plane::thinking, arbitration::EventKind::fault,
        std::to_string(events_left_out_) + " earlier events of this plane are left out"};
    events_.front().time = events_.size() > 1 ? events_[1].time : event.time;
  }
  events_.push_back(event);
}

std::string Planes::finish() {
  std::string fault;
  for (const auto& [thread, plane] : {std::pair(thinking_.get(), "thinking plane: "),
                                      std::pair(forecasting_.get(), "forecaster: ")}) {
    const std::string thrown = thread == nullptr ? "" : thread->finish();
    fault += thrown.empty() ? "" : (fault.empty() ? "" : "; ") + (plane + thrown);
  }
  hand_over_thoughts();
  return fault;
}

PlanesTiming Planes::timing() const {
  PlanesTiming timing;
  if (!reflex_times_.empty()) {
    std::vector<double> sorted = reflex_times_;
    std::sort(sorted.begin(), sorted.end());
    timing = {.calls = sorted.size(),
              .p50 = sorted[sorted.size() / 2],
              .max = sorted.back(),
              .sum = std::accumulate(sorted.begin(), sorted.end(), 0.0)};
  }
  if (thinking_ != nullptr) {
    timing.thinking = thinking_->computed();
  }
  if (forecasting_ != nullptr) {
    timing.forecasting = forecasting_->computed();
  }
  return timing;
}

}  // namespace saca::runtime
