#include "saca/preview/expected_harm.h"

#include "saca/core/contract.h"
#include "saca/intent/joint.h"
#include "saca/outcome/ordering.h"
#include "saca/world/time_to_conflict.h"

namespace saca::preview {
namespace {

using manoeuvre::PolicyId;
using world::Scene;
using world::Track;

constexpr double motion_horizon = 10.0;  // [s]: beyond it somebody stands where it is
constexpr double told_apart = 0.05;      // of an intention that is told apart

intent::Choices likely_choices(const intent::Belief& belief) {
  intent::Choices choices = intent::choices_of(belief.now(), told_apart);
  if (choices.empty()) {
    choices.push_back({intent::likeliest(belief.now()), 1.0});
  }
  return choices;
}

/// nullopt: the atlas does not hold all that can be driven.
std::optional<std::vector<PolicyFacts>> judged(const Scene& scene, const std::vector<Track>& tracks,
                                               std::span<const manoeuvre::Plan> plans,
                                               const ForecastTools& tools, Physics physics) {
  return physics == Physics::atlas ? read_plans(scene, tracks, plans, tools)
                                   : rolled_out(scene, tracks, plans, tools);
}

}  // namespace

std::vector<JointMotion> joint_motions(const Scene& scene, const intent::Beliefs& beliefs,
                                       const intent::MotionLaw& law, std::size_t most) {
  expects(beliefs.size() == scene.actors.size(), "one belief per actor");
  std::vector<intent::Choices> choices;
  for (const intent::Belief& belief : beliefs) {
    choices.push_back(likely_choices(belief));
  }
  std::vector<JointMotion> motions;
  double sum = 0.0;
  for (const intent::Hypothesis& hypothesis : intent::likeliest_hypotheses(choices, most)) {
    JointMotion& motion = motions.emplace_back();
    motion.probability = hypothesis.probability;
    sum += hypothesis.probability;
    for (std::size_t i = 0; i < scene.actors.size(); ++i) {
      motion.tracks.push_back(intent::motion_under(scene, scene.actors[i], hypothesis.intentions[i],
                                                   motion_horizon, law)
                                  .track);
    }
  }
  for (JointMotion& motion : motions) {
    motion.probability /= sum;
  }
  return motions;
}

JointMotion all_going_on(const Scene& scene) {
  JointMotion motion;
  for (const world::Actor& actor : scene.actors) {
    Track track{.start = scene.time, .step = intent::motion_step, .X_WA = {}};
    const int last = static_cast<int>(motion_horizon / track.step);
    for (int k = 0; k <= last; ++k) {
      track.X_WA.push_back(world::actor_going_on(actor, k * track.step));
    }
    motion.tracks.push_back(std::move(track));
  }
  return motion;
}

std::vector<ExpectedHarm> expected_harms(const Scene& scene, std::span<const JointMotion> motions,
                                         const ForecastTools& tools, Physics physics) {
  expects(!motions.empty(), "at least one joint motion");
  const std::vector<manoeuvre::Plan> plans = all_plans(scene.ego.v_B.x);
  std::vector<ExpectedHarm> all(plans.size());
  double sum = 0.0;
  for (const JointMotion& motion : motions) {
    const auto facts = judged(scene, motion.tracks, plans, tools, physics);
    if (!facts) {
      return expected_harms(scene, motions, tools, Physics::rolled_out);
    }
    for (std::size_t i = 0; i < plans.size(); ++i) {
      all[i].refusal = (*facts)[i].refusal;
      all[i].harm += motion.probability * (*facts)[i].outcome.harm;
      all[i].contact += motion.probability * (*facts)[i].probability;
    }
    sum += motion.probability;
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    all[i].plan = plans[i];
    all[i].harm /= sum;
    all[i].contact /= sum;
  }
  return all;
}

manoeuvre::Plan least_harmful(std::span<const ExpectedHarm> all) {
  const ExpectedHarm* best = nullptr;
  for (const ExpectedHarm& one : all) {
    if (!one.refusal.empty()) {
      continue;
    }
    const auto outcome_of = [](const ExpectedHarm& each) {
      return outcome::Outcome{.harm = each.harm};
    };
    if (best == nullptr ||
        outcome::better(outcome_of(one), one.plan.policy, outcome_of(*best), best->plan.policy)) {
      best = &one;
    }
  }
  return best == nullptr ? manoeuvre::Plan{PolicyId::aeb, std::nullopt} : best->plan;
}

}  // namespace saca::preview
