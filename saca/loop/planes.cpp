#include "saca/loop/planes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "saca/core/names.h"

namespace saca::loop {
namespace {

constexpr std::array<std::string_view, 2> pace_names{"real", "lockstep"};

std::optional<decide::TriggerCheck> trigger_check(const PlanesSetup& setup) {
  return setup.forecast.atlas == nullptr
             ? std::nullopt
             : std::optional<decide::TriggerCheck>(std::in_place, *setup.forecast.atlas,
                                                   *setup.forecast.harm);
}

}  // namespace

std::string_view name(Pace pace) {
  return name_of(pace, pace_names);
}

Planes::Planes(const PlanesSetup& setup, Listener listener, std::size_t looks)
    : setup_(setup),
      listener_(std::move(listener)),
      charged_model_(setup.model == nullptr
                         ? nullptr
                         : std::make_unique<ChargedModel>(*setup.model, setup.costs, *setup.clock,
                                                          simulated_clock_)),
      charged_(setup.costs.preview, simulated_clock_),
      reflex_(setup.thresholds, trigger_check(setup), setup.forced, setup.guard),
      plane_(tools(), setup.thresholds, output()) {
  reflex_times_.reserve(looks);
  if (real()) {
    thread_ = std::make_unique<ThinkingThread>(plane_, scenes_, *setup_.clock);
  }
}

decide::ThinkingTools Planes::tools() {
  decide::ThinkingTools tools{.forecast = setup_.forecast,
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

decide::ThinkingOutput Planes::output() {
  return {.publish =
              [this](const decide::PlanCache& plans, double ready) {
                real() ? plans_.publish(plans) : charged_.publish(plans, ready);
              },
          .event =
              [this](const decide::Event& event) {
                events_.push_back(event);
                listener_.event(event);
              },
          .reasoning = [this](std::int32_t preview,
                              std::string_view text) { listener_.reasoning(preview, text); }};
}

decide::Reflex Planes::step(const world::Scene& scene, const intent::Beliefs& beliefs,
                            Clock::Time at) {
  if (!decision()) {
    if (real()) {
      scenes_.publish({scene, beliefs, at});
    } else {
      charged_.think(plane_, scene, beliefs);
    }
  }
  const Clock::Time before = setup_.clock->now();
  hand_over_plans(scene.time);
  const decide::Reflex reflex = reflex_.step(scene);
  reflex_times_.push_back(to_seconds(setup_.clock->now() - before));
  return reflex;
}

void Planes::hand_over_plans(double now) {
  if (!real()) {
    if (const auto plans = charged_.take(now)) {
      reflex_.receive(*plans);
    }
    return;
  }
  decide::PlanCache plans;
  if (plans_.take(plans)) {
    reflex_.receive(plans);
  }
}

std::string Planes::finish() {
  return thread_ ? thread_->finish() : "";
}

ReflexTiming Planes::timing() const {
  if (reflex_times_.empty()) {
    return {};
  }
  std::vector<double> sorted = reflex_times_;
  std::sort(sorted.begin(), sorted.end());
  return {sorted.size(), sorted[sorted.size() / 2], sorted.back()};
}

}  // namespace saca::loop
