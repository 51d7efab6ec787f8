#include "saca/decide/reflex_plane.h"

#include <array>

#include "saca/core/names.h"

namespace saca::decide {
namespace {

constexpr std::array<std::string_view, 4> source_names{"fallback", "memory", "model", "forced"};

}  // namespace

std::string_view name(Source source) {
  return name_of(source, source_names);
}

Decision ReflexPlane::decide(const world::Scene& scene) noexcept {
  Decision decision{.plan = {manoeuvre::PolicyId::aeb, std::nullopt}, .time = scene.time};
  const CachedPlan* best = nullptr;
  const memory::Features here = memory::features(scene);
  for (const CachedPlan& cached : plans_) {
    const double similarity = memory::similarity(here, cached.at_trigger);
    if (!decision.similarity || similarity > *decision.similarity) {
      decision.similarity = similarity;
      decision.preview = cached.preview;
      best = &cached;
    }
  }
  if (forced_) {
    decision.plan = *forced_;
    decision.source = Source::forced;
  } else if (best != nullptr && *decision.similarity > match_similarity) {
    const bool guarded = guard_ == Guard::never_worse_than_braking;
    decision.gave_way_to_aeb = guarded && best->worse_than_aeb;
    if (guarded && check_ && !best->worse_than_aeb &&
        best->plan.policy != manoeuvre::PolicyId::aeb) {
      decision.forecast = check_->compare(best->plan, scene);
      decision.gave_way_to_aeb = decision.forecast && decision.forecast->plan_harms_more();
    }
    if (!decision.gave_way_to_aeb) {
      decision.plan = best->plan;
      decision.source = best->source;
    }
  }
  return decision;
}

Reflex ReflexPlane::step(const world::Scene& scene) noexcept {
  Reflex reflex;
  if (decision_) {
    reflex.plan = decision_->plan;
  }
  if (world::broken_rule(scene)) {
    reflex.refused_scene = true;
    return reflex;
  }
  reflex.threat =
      preview::nearest_threat(scene, thresholds_.preview, thresholds_.trigger_tolerance);
  if (!decision_ && preview::triggers(reflex.threat, thresholds_)) {
    decision_ = decide(scene);
    reflex.plan = decision_->plan;
    reflex.triggered = true;
  }
  return reflex;
}

}  // namespace saca::decide
