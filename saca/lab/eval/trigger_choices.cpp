#include "saca/lab/eval/trigger_choices.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "saca/lab/eval/danger_choice.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/preview/drawn_motions.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/preview.h"

namespace saca::eval {
namespace {

using encounter::Action;
using encounter::View;
using manoeuvre::full_braking;
using manoeuvre::Plan;
using preview::JointMotion;
using preview::Physics;

std::vector<JointMotion> believed(const View& view) {
  return preview::joint_motions(view.scene, view.beliefs, intent::MotionLaw{});
}

Action least_expected(const world::Scene& scene, std::span<const JointMotion> motions,
                      const runtime::PlanesSetup& setup, Physics physics) {
  return {.plan = preview::least_harmful(
              preview::expected_harms(scene, motions, setup.forecast, physics)),
          .source = "forecast"};
}

/// Over draws of all that is not known of the others.
std::vector<preview::ExpectedHarm> expected_over_draws(const View& view,
                                                       const runtime::PlanesSetup& setup) {
  return preview::expected_harms(view.scene, arbitration::draws_of(view.scene, view.beliefs),
                                 setup.forecast, Physics::rolled_out);
}

/// How the others will truly move while the ego goes on.
JointMotion true_motion(const encounter::ClosedLoop& truth, const world::Scene& scene) {
  manoeuvre::EgoMotion ego;
  ego.track = {.start = scene.time, .step = 0.01, .X_WA = {}};
  for (int k = 0; k <= 1'000; ++k) {
    ego.track.X_WA.push_back(world::ego_going_on(scene, 0.01 * k));
    ego.v_B.push_back(scene.ego.v_B);
    ego.yaw_rate.push_back(scene.ego.yaw_rate);
  }
  return {.probability = 1.0, .tracks = truth.truth().others()(ego)};
}

/// As preview::expected_harms rolled out, but with how the others move and react, grip and car
/// given.
Action least_tried(const world::Scene& scene, std::span<const JointMotion> motions,
                   const std::function<collision::Others(const JointMotion&)>& others, double grip,
                   const manoeuvre::ParameterPerturbation& perturbation,
                   const runtime::PlanesSetup& setup) {
  const auto plans = forecast::all_plans(scene.ego.v_B.x);
  std::vector<preview::ExpectedHarm> all(plans.size());
  for (const JointMotion& motion : motions) {
    const collision::Others moved = others(motion);
    std::vector<rollout::Attempt> attempts;
    attempts.reserve(plans.size());
    for (const Plan& plan : plans) {
      attempts.push_back({plan, &scene, &moved, grip, perturbation});
    }
    const auto tried = preview::tried(*setup.forecast.car, attempts, *setup.forecast.harm);
    for (std::size_t i = 0; i < plans.size(); ++i) {
      all[i].plan = plans[i];
      all[i].add(tried[i].facts, motion.probability);
    }
  }
  return {.plan = preview::least_harmful(all), .source = "forecast"};
}

/// Where somebody of one scene stands in another; nullopt: nowhere.
std::optional<std::size_t> index_of(const world::Actor& actor, const world::Scene& scene) {
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (scene.actors[i].kind == actor.kind && scene.actors[i].id == actor.id) {
      return i;
    }
  }
  return std::nullopt;
}

/// What is believed of all but the followers, who do what they truly will.
collision::Others with_true_followers(const View& view, const JointMotion& motion) {
  const world::Scene cast = view.truth.truth().whole_scene();
  std::vector<std::pair<std::size_t, std::size_t>> known;  // in the scene, in the cast
  for (const std::size_t i : reflex::followers_of(view.scene)) {
    if (const auto k = index_of(view.scene.actors[i], cast)) {
      known.emplace_back(i, *k);
    }
  }
  return [tracks = motion.tracks, known,
          others = view.truth.truth().others()](const manoeuvre::EgoMotion& ego) {
    std::vector<world::Track> moved = tracks;
    const std::vector<world::Track> truly = others(ego);
    for (const auto& [i, k] : known) {
      moved[i] = truly[k];
    }
    return moved;
  };
}

/// Without any forecast.
AtTrigger::Choose by_rule(std::string_view name, const MethodTools& tools) {
  if (name == "aeb") {
    return [](const View&) { return Action{.plan = full_braking}; };
  }
  if (name == "random") {
    return [rng = std::mt19937_64(tools.seed)](const View& view) mutable {
      const auto policy = manoeuvre::all_policies[std::uniform_int_distribution<std::size_t>(
          0, manoeuvre::num_policies - 1)(rng)];
      return Action{.plan = manoeuvre::default_plan(policy, view.scene.ego.v_B.x)};
    };
  }
  if (find_method(name)->needs == Needs::imitator) {
    return [imitator = &tools.imitators->find(name)->second](const View& view) {
      return Action{
          .plan = manoeuvre::default_plan(imitator->choice(view.scene), view.scene.ego.v_B.x)};
    };
  }
  return {};
}

/// By what is believed of the others.
AtTrigger::Choose by_beliefs(std::string_view name, const MethodTools& tools) {
  const runtime::PlanesSetup& setup = tools.saca;
  if (name == "going_on_atlas") {
    return [setup](const View& view) {
      const JointMotion motion = preview::all_going_on(view.scene);
      return least_expected(view.scene, {&motion, 1}, setup, Physics::atlas);
    };
  }
  if (name == "beliefs_atlas" || name == "beliefs_rolled_out") {
    const Physics physics = name == "beliefs_atlas" ? Physics::atlas : Physics::rolled_out;
    return [setup, physics](const View& view) {
      return least_expected(view.scene, believed(view), setup, physics);
    };
  }
  if (name == "beliefs_drawn") {
    return [setup](const View& view) {
      return Action{.plan = preview::least_harmful(expected_over_draws(view, setup)),
                    .source = "forecast"};
    };
  }
  if (name == "beliefs_and_experience") {
    return [setup, experience = tools.experience](const View& view) {
      auto all = expected_over_draws(view, setup);
      const memory::Corrections corrections = experience->corrections(view.scene);
      for (preview::ExpectedHarm& one : all) {
        one.harm = std::max(0.0, one.harm + corrections[manoeuvre::index(one.plan.policy)]);
      }
      return Action{.plan = preview::least_harmful(all), .source = "forecast"};
    };
  }
  return {};
}

/// By V_h, learnt.
AtTrigger::Choose by_danger(std::string_view name, const MethodTools& tools) {
  const runtime::PlanesSetup& setup = tools.saca;
  if (name == "least_danger" || name == "least_joint_danger") {
    const Beside beside = name == "least_danger" ? Beside::each : Beside::all;
    return [setup, network = tools.danger, beside](const View& view) {
      const manoeuvre::Car& car = *setup.forecast.car;
      return Action{.plan = of_least_danger(view.scene, drivable_plans(car, view.scene), car,
                                            *network, beside),
                    .source = "danger"};
    };
  }
  if (name == "beliefs_and_danger") {
    return [setup, network = tools.danger](const View& view) {
      const auto plans = admissible_plans(
          preview::expected_harms(view.scene, believed(view), setup.forecast, Physics::atlas));
      return Action{
          .plan = of_least_danger(view.scene, plans, *setup.forecast.car, *network, Beside::all),
          .source = "danger"};
    };
  }
  return {};
}

/// By what is believed, told one thing that nobody on a road can know.
AtTrigger::Choose by_beliefs_told_more(std::string_view name, const MethodTools& tools) {
  const runtime::PlanesSetup& setup = tools.saca;
  if (name == "beliefs_and_grip") {
    return [setup](const View& view) {
      return least_tried(
          view.scene, believed(view),
          [&](const JointMotion& motion) {
            return reflex::with_reacting_followers(view.scene, motion.tracks);
          },
          view.truth.truth().grip(), view.truth.truth().perturbation_from_now(), setup);
    };
  }
  if (name == "beliefs_and_followers") {
    return [setup](const View& view) {
      return least_tried(
          view.scene, believed(view),
          [&](const JointMotion& motion) { return with_true_followers(view, motion); },
          view.scene.grip, {}, setup);
    };
  }
  if (name == "beliefs_and_hidden") {
    return [setup, intent = tools.intent](const View& view) {
      world::Scene scene = view.truth.truth().whole_scene();
      scene.grip = view.scene.grip;
      scene.ego_mass = view.scene.ego_mass;
      intent::Beliefs beliefs = intent::beliefs_at_sight(*intent, scene);
      for (std::size_t i = 0; i < scene.actors.size(); ++i) {  // what is believed of whom it knows
        if (const auto k = index_of(scene.actors[i], view.scene)) {
          beliefs[i] = view.beliefs[*k];
        }
      }
      return least_expected(scene, preview::joint_motions(scene, beliefs, intent::MotionLaw{}),
                            setup, Physics::rolled_out);
    };
  }
  return {};
}

/// By what will truly happen.
AtTrigger::Choose by_truth(std::string_view name, const MethodTools& tools) {
  const runtime::PlanesSetup& setup = tools.saca;
  if (name == "true_atlas") {
    return [setup](const View& view) {
      world::Scene scene = view.truth.truth().whole_scene();
      scene.grip = view.scene.grip;
      const JointMotion motion = true_motion(view.truth, scene);
      return least_expected(scene, {&motion, 1}, setup, Physics::atlas);
    };
  }
  if (name == "true_rolled_out") {
    return [setup](const View& view) {
      const auto tried =
          try_all(view.truth, *setup.forecast.car, *setup.forecast.harm, Knowledge::motions);
      return Action{.plan = tried[best_of(tried)].facts.plan};
    };
  }
  if (name == "oracle") {
    return [hindsight = tools.hindsight](const View& view) {
      const auto& tried = hindsight->at(view.truth);
      return Action{.plan = tried[best_of(tried)].facts.plan};
    };
  }
  return {};
}

}  // namespace

AtTrigger::Choose trigger_choice(std::string_view name, const MethodTools& tools) {
  for (const auto& way : {by_rule, by_beliefs, by_danger, by_beliefs_told_more, by_truth}) {
    if (AtTrigger::Choose choose = way(name, tools)) {
      return choose;
    }
  }
  return {};
}

}  // namespace saca::eval
