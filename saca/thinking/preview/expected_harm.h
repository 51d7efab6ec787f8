#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/approach.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/intent/motion.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::preview {

/// How far joint motions reach [s]: beyond it everybody stands where it is.
constexpr double motion_horizon = 10.0;

/// One way in which all others together may move on from a scene.
struct JointMotion {
  double probability = 1.0;
  std::vector<world::Track> tracks;  ///< one per actor of the scene
};

/// The likeliest joint motions under what is believed of each road user now: everybody moves by the
/// law under one of the intentions that it has with 5 % at least, independently of the others.
/// @param beliefs  one per actor of the scene
/// @param most     how many are wanted, >= 1
/// @return         likeliest first; their probabilities sum to 1; of an empty scene, one
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] std::vector<JointMotion> joint_motions(const world::Scene& scene,
                                                     const intent::Beliefs& beliefs,
                                                     const intent::MotionLaw& law,
                                                     std::size_t most = 8);

/// Everybody goes on as it does (world::actor_going_on): the one joint motion of rules that look at
/// the present only.
[[nodiscard]] JointMotion all_going_on(const world::Scene& scene);

/// What one plan is expected to end in.
struct ExpectedHarm {
  manoeuvre::Plan plan;
  std::string refusal;   ///< empty when the plan can be driven; else the rest means nothing
  double harm = 0.0;     ///< mean over the joint motions
  double contact = 0.0;  ///< likewise: probability of contact
  /// Of PreparedMotions alone: both over the first half of the joint motions (halves rounded up),
  /// to be held against what is worked out for those only.
  double harm_by_half = 0.0;
  double contact_by_half = 0.0;

  /// What it ends in under one more joint motion, which has this share of the mean; or why it
  /// cannot be driven.
  void add(const PolicyFacts& facts, double share);
};

/// With what a plan is forecast.
enum class Physics : std::uint8_t {
  atlas,       ///< first contacts only, with the scene's spread; microseconds
  rolled_out,  ///< full dynamics and everything that follows a contact; the scene's mean
};

/// Every plan that can be chosen (all_plans), held against every joint motion; followers react.
///
/// Where the atlas does not hold a plan, all of them are rolled out.
/// @param motions  at least one; weighted by their probabilities, which need not sum to 1
[[nodiscard]] std::vector<ExpectedHarm> expected_harms(const world::Scene& scene,
                                                       std::span<const JointMotion> motions,
                                                       const ForecastTools& tools, Physics physics);
/// The same of some plans, in their order.
[[nodiscard]] std::vector<ExpectedHarm> expected_harms(const world::Scene& scene,
                                                       std::span<const JointMotion> motions,
                                                       const ForecastTools& tools, Physics physics,
                                                       std::span<const manoeuvre::Plan> plans);

/// Joint motions from a scene, with what is worked out of their tracks once, however much is held
/// against them: full dynamics and everything that follows a contact. Refers to scene and motions.
class PreparedMotions {
 public:
  /// @param motions  as in expected_harms
  PreparedMotions(const world::Scene& scene, std::span<const JointMotion> motions,
                  const ForecastTools& tools);
  PreparedMotions(const PreparedMotions&) = delete;  // parts of it refer to one another
  PreparedMotions& operator=(const PreparedMotions&) = delete;

  /// As expected_harms.
  [[nodiscard]] std::vector<ExpectedHarm> harms(std::span<const manoeuvre::Plan> plans) const;
  /// The same of plans that begin only after the ego has gone on for a while.
  /// @param delay  for which it goes on [s], >= 0, below motion_horizon; told to 10 ms
  /// @return       in the order of `plans`; refused where it cannot be driven from there
  /// @throws ContractViolation  if the delay is out of range
  [[nodiscard]] std::vector<ExpectedHarm> harms_later(double delay,
                                                      std::span<const manoeuvre::Plan> plans) const;
  /// The same of one way of the ego, whatever it came from.
  /// @param way  from scene.time on
  /// @return     `plan` is left as it is
  [[nodiscard]] ExpectedHarm harm(const manoeuvre::EgoMotion& way) const;

 private:
  [[nodiscard]] std::vector<ExpectedHarm> harms_of(
      const std::vector<std::optional<manoeuvre::EgoMotion>>& ways,
      std::span<const manoeuvre::Plan> plans, const world::Scene& from) const;

  const world::Scene& scene_;
  std::span<const JointMotion> motions_;
  ForecastTools tools_;
  std::vector<std::vector<collision::Mover>> movers_;  ///< of each motion, one per actor
};

/// The plan of the least expected harm by the one ordering (collision/ordering.h): equal classes of
/// harm go to the milder policy, and of one policy to the plan that all_plans has first: of braking
/// to the hardest. Emergency braking, where none can be driven.
[[nodiscard]] manoeuvre::Plan least_harmful(std::span<const ExpectedHarm> all);

}  // namespace saca::preview
