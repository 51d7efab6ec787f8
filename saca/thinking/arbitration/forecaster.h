#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/under_way.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/preview/expected_harm.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::arbitration {

/// What makes verdicts: as Forecaster::judge. May throw.
using Judge = std::function<reflex::Verdict(const world::Scene&, const intent::Beliefs&,
                                            const std::optional<reflex::UnderWay>&)>;

/// Draws of a verdict: with 16 the regret in closed loop is that with 64 (docs/decisions/0018).
constexpr std::size_t usual_draws = 16;

/// What the forecaster holds every plan against: draws of what the others may do from this scene on
/// (preview::drawn_motions). The same scene and beliefs give the same draws.
///
/// @param beliefs    one per actor
/// @param num_draws  >= 1
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] std::vector<preview::JointMotion> draws_of(const world::Scene& scene,
                                                         const intent::Beliefs& beliefs,
                                                         std::size_t num_draws = usual_draws);

/// How many times as long as that of a scene without cues the verdict of this one takes: 1, and 0.6
/// more for each supposition (Forecaster::judge).
/// @param law  by which it is judged; nullptr: cues stand for nothing
/// @throws ContractViolation  if beliefs and actors differ in number
[[nodiscard]] double judgements_of(const world::Scene& scene, const intent::Beliefs& beliefs,
                                   const intent::CueLaw* law);

/// The plane between reflex and thinking: one scene in, one verdict out, many times a second. Its
/// work is bounded: it asks neither disk nor language model.
///
/// Every plan is driven with full dynamics and held against draws of what the others may do
/// (draws_of), with everything that follows a contact; those behind react to it.
class Forecaster {
 public:
  /// @param num_draws  >= 1
  explicit Forecaster(const preview::ForecastTools& tools, std::size_t num_draws = usual_draws);

  /// Where the scene has cues, what they stand for is reckoned with, by ForecastTools::cues
  /// (preview::suppositions): each is judged by itself, over half of the draws, and held against
  /// what is seen in the same half; harms are the mean over them and what is seen, as likely as
  /// they are.
  ///
  /// * Suppositions are only added: everybody who is seen counts as without.
  /// * A cue alone never takes the wheel, nor keeps it: where without it the verdict speaks for
  ///   doing nothing, it is that without it. What waiting costs is always as without.
  /// * Where there would be less grip, the car is driven as if it knew; a plan that could not be
  ///   driven then counts as doing nothing does; the plan under way is judged on the grip that is
  ///   believed.
  /// * Each plan tells its harm without cues, too (`JudgedPlan::as_seen`).
  ///
  /// @param scene      breaks no rule of world::broken_rule
  /// @param beliefs    one per actor
  /// @param under_way  judged from where it is: the rest of the way that was meant when it began,
  ///                   from the present place and direction back onto it. While it is braking
  ///                   that harms less than `material_harm`, nothing is better by so much: then the
  ///                   verdict has only that, harder braking and the next gentler, and doing
  ///                   nothing
  /// @throws ContractViolation  if beliefs and actors differ in number
  [[nodiscard]] reflex::Verdict judge(
      const world::Scene& scene, const intent::Beliefs& beliefs,
      const std::optional<reflex::UnderWay>& under_way = std::nullopt) const;

 private:
  /// How much of a verdict is worked out.
  struct Depth {
    bool half = false;         ///< by the first half of the draws (rounded up)
    bool later = true;         ///< Verdict::later, too
    bool may_be_short = true;  ///< see judge: while braking that harms little is under way
  };
  struct BothDepths {
    reflex::Verdict verdict;
    reflex::Verdict by_half;  ///< its plans and the one under way by the first half of the draws
  };
  [[nodiscard]] BothDepths judge_as_seen(const world::Scene& scene, const intent::Beliefs& beliefs,
                                         const std::optional<reflex::UnderWay>& under_way,
                                         const Depth& depth) const;

  preview::ForecastTools tools_;
  std::size_t num_draws_;
};

[[nodiscard]] reflex::JudgedPlan judged(const preview::ExpectedHarm& one);

/// A Forecaster as a judge.
[[nodiscard]] Judge judge_with(const preview::ForecastTools& tools);

}  // namespace saca::arbitration
