#include "saca/thinking/preview/expected_harm.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/forecast/prepared_motion.h"
#include "saca/thinking/intent/joint.h"
#include "saca/thinking/preview/follower_answers.h"
#include "saca/thinking/rollout/batch.h"
#include "saca/thinking/rollout/collision_sequence.h"

namespace saca::preview {
namespace {

using collision::Mover;
using manoeuvre::EgoMotion;
using manoeuvre::PolicyId;
using world::Scene;
using world::Track;

constexpr double least_probability = 0.05;  // of an intention that has a motion of its own

intent::Choices likely_choices(const intent::Belief& belief) {
  intent::Choices choices = intent::choices_of(belief.now(), least_probability);
  if (choices.empty()) {
    choices.push_back({intent::likeliest(belief.now()), 1.0});
  }
  return choices;
}

double weight_of(std::span<const JointMotion> motions) {
  expects(!motions.empty(), "at least one joint motion");
  double sum = 0.0;
  for (const JointMotion& motion : motions) {
    sum += motion.probability;
  }
  return sum;
}

/// Every few poses of a motion: what lies between is straight, to millimetres. Its last pose is
/// kept where it rests there: else it would seem to move on as it did a moment before.
EgoMotion thinned(const EgoMotion& motion) {
  constexpr std::size_t every = 5;
  EgoMotion thin{.track = {.start = motion.track.start,
                           .step = static_cast<double>(every) * motion.track.step,
                           .X_WA = {}},
                 .ended = motion.ended};
  const auto keep = [&](std::size_t k) {
    thin.track.X_WA.push_back(motion.track.X_WA[k]);
    thin.v_B.push_back(motion.v_B[k]);
    thin.yaw_rate.push_back(motion.yaw_rate[k]);
  };
  const std::size_t last = motion.track.X_WA.size() - 1;
  for (std::size_t k = 0; k <= last; k += every) {
    keep(k);
  }
  if (last % every != 0 && motion.ended && !collision::moves_at_end(motion)) {
    keep(last);
  }
  return thin;
}

/// One way of the ego, held against one joint motion after the other. Who follows reacts to the ego
/// alone, so it does the same in all of them until the ego is struck.
class HeldWay {
 public:
  HeldWay(const Scene& scene, const EgoMotion& way, const collision::HarmModel& harm)
      : scene_(scene),
        harm_(harm),
        way_(thinned(way)),
        motion_(way_, scene),
        answers_(scene, scene.time + motion_horizon, reacting_step),
        answered_(answers_.followers().size()) {
    if (!answered_.empty()) {
      answers_.remember(motion_.intended().track);
    }
  }

  /// @param others  the motion's tracks
  [[nodiscard]] collision::Outcome against(std::span<const Mover> others) {
    if (answered_.empty()) {
      return rollout::judge_contacts(motion_, others, harm_);
    }
    return rollout::judge_contacts(
        motion_, others, harm_,
        [&](const Track& X_WB, std::span<const bool> struck, std::span<const Mover*> movers) {
          react(X_WB, struck, others, movers);
        });
  }

 private:
  static constexpr double reacting_step = 1.0 / 16.0;  // [s]

  /// A follower where it is drawn to be.
  struct FollowerMotion {
    Track X_WA;
    std::optional<Mover> mover;
  };

  /// @param drawn  those who react in it, too
  void react(const Track& X_WB, std::span<const bool> struck, std::span<const Mover> drawn,
             std::span<const Mover*> movers) {
    const reflex::Followers& followers = answers_.followers();
    std::size_t num = followers.size();
    while (num > 0 && struck[followers[num - 1]]) {
      --num;  // nobody looks at it any more
    }
    if (num == 0) {
      return;
    }
    const Track& meant = motion_.intended().track;
    if (&X_WB != &meant && !has_steps_) {
      has_steps_ = true;
      answers_.remember(motion_.in_steps_of(X_WB.step));
    }
    const std::span<const Track> tracks = answers_.to(X_WB, num);
    for (std::size_t k = 0; k < num; ++k) {
      const std::size_t i = followers[k];
      if (struck[i]) {
        continue;
      }
      const Vec2 off = drawn[i].track().X_WA.front().p - scene_.actors[i].X_WA.p;
      FollowerMotion& answered = answered_[k];
      answered.X_WA = tracks[k];
      for (Pose& pose : answered.X_WA.X_WA) {
        pose.p = pose.p + off;
      }
      movers[i] = &answered.mover.emplace(scene_.actors[i].footprint, answered.X_WA);
    }
  }

  const Scene& scene_;
  const collision::HarmModel& harm_;
  EgoMotion way_;
  forecast::PreparedMotion motion_;
  FollowerAnswers answers_;
  std::vector<FollowerMotion> answered_;
  bool has_steps_ = false;  ///< remembered is also what answers the steps of a struck ego
};

/// What comes of a way where all move so.
struct Told {
  double harm = 0.0;
  double contact = 0.0;  ///< probability
};

/// Where whom the ego meets first may not be there, all that is told after it counts as likely as
/// it is (forecast::expected_harm); as likely as it is not, the ego drives on to what stands behind
/// it.
/// @param doubts  how many that may not be there are driven through, one behind the other
Told told_with_doubts(HeldWay& held, const Scene& scene, const std::vector<Mover>& movers,
                      int doubts) {
  constexpr double sure = 0.95;  // what stands behind is worth less than a twentieth then
  const collision::Outcome outcome = held.against(movers);
  const Told told{.harm = outcome.harm, .contact = outcome.contact ? 1.0 : 0.0};
  const auto first = outcome.contact ? outcome.contact->actor : std::nullopt;
  if (!first || doubts == 0 || scene.actors[*first].existence >= sure) {
    return told;
  }
  static const Track elsewhere{.start = 0.0, .step = 1.0, .X_WA = {{{1e7, 1e7}, 0.0}}};
  std::vector<Mover> without = movers;
  without[*first] = Mover(scene.actors[*first].footprint, elsewhere);
  const Told behind = told_with_doubts(held, scene, without, doubts - 1);
  const double existence = scene.actors[*first].existence;
  return {.harm = told.harm + (1.0 - existence) * behind.harm,
          .contact = existence + (1.0 - existence) * behind.contact};
}

/// Ways of the ego that can be driven, no longer than the others' motions; in the order of `plans`.
std::vector<std::optional<EgoMotion>> ways_of(const Scene& scene,
                                              std::span<const manoeuvre::Plan> plans,
                                              const ForecastTools& tools) {
  std::vector<rollout::Drive> drives;
  std::vector<std::size_t> driven;  // whose drives they are
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (!manoeuvre::why_refused(*tools.car, plans[i], scene)) {
      drives.push_back(rollout::drive_from(*tools.car, plans[i], scene, motion_horizon));
      driven.push_back(i);
    }
  }
  std::vector<EgoMotion> motions = rollout::drive_all(drives, motion_horizon);
  std::vector<std::optional<EgoMotion>> ways(plans.size());
  for (std::size_t k = 0; k < driven.size(); ++k) {
    ways[driven[k]] = std::move(motions[k]);
  }
  return ways;
}

/// A way that begins where another has come to after some samples.
EgoMotion continued(const EgoMotion& before, std::size_t count, const EgoMotion& after) {
  const auto end = static_cast<std::ptrdiff_t>(count);
  EgoMotion whole{.track = {.start = before.track.start, .step = before.track.step, .X_WA = {}},
                  .ended = after.ended};
  const auto join = [&](auto& into, const auto& first, const auto& second) {
    into.assign(first.begin(), first.begin() + end);
    into.insert(into.end(), second.begin(), second.end());
  };
  join(whole.track.X_WA, before.track.X_WA, after.track.X_WA);
  join(whole.v_B, before.v_B, after.v_B);
  join(whole.yaw_rate, before.yaw_rate, after.yaw_rate);
  return whole;
}

/// nullopt: the atlas does not hold all that can be driven.
std::optional<std::vector<ExpectedHarm>> read(const Scene& scene,
                                              std::span<const JointMotion> motions,
                                              std::span<const manoeuvre::Plan> plans, double sum,
                                              const ForecastTools& tools) {
  std::vector<ExpectedHarm> all(plans.size());
  for (const JointMotion& motion : motions) {
    const auto facts = read_plans(scene, motion.tracks, plans, tools);
    if (!facts) {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < plans.size(); ++i) {
      all[i].add((*facts)[i], motion.probability / sum);
    }
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    all[i].plan = plans[i];
  }
  return all;
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
  const forecast::Plans plans = forecast::all_plans(scene.ego.v_B.x, tools.braking);
  return expected_harms(scene, motions, tools, physics, {plans.begin(), plans.size()});
}

std::vector<ExpectedHarm> expected_harms(const Scene& scene, std::span<const JointMotion> motions,
                                         const ForecastTools& tools, Physics physics,
                                         std::span<const manoeuvre::Plan> plans) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  if (physics == Physics::atlas) {
    if (auto all = read(scene, motions, plans, weight_of(motions), tools)) {
      return *std::move(all);
    }
  }
  return PreparedMotions(scene, motions, tools).harms(plans);
}

PreparedMotions::PreparedMotions(const Scene& scene, std::span<const JointMotion> motions,
                                 const ForecastTools& tools)
    : scene_(scene), motions_(motions), tools_(tools) {
  expects(tools.car != nullptr && tools.harm != nullptr, "car and harm are given");
  movers_.reserve(motions.size());
  for (const JointMotion& motion : motions) {
    movers_.push_back(forecast::movers_of(scene, motion.tracks));
  }
}

std::vector<ExpectedHarm> PreparedMotions::harms(std::span<const manoeuvre::Plan> plans) const {
  return harms_of(ways_of(scene_, plans, tools_), plans, scene_);
}

std::vector<ExpectedHarm> PreparedMotions::harms_later(
    double delay, std::span<const manoeuvre::Plan> plans) const {
  expects(delay >= 0.0 && delay < motion_horizon, "a delay within the others' motions");
  const auto going_on = ways_of(scene_, {&manoeuvre::doing_nothing, 1}, tools_).front();
  if (!going_on) {
    const auto why = manoeuvre::refusal(*tools_.car, manoeuvre::doing_nothing, scene_);
    std::vector<ExpectedHarm> refused;
    for (const manoeuvre::Plan& plan : plans) {
      refused.push_back({.plan = plan, .refusal = *why});
    }
    return refused;
  }
  const Track& track = going_on->track;
  const auto count =
      std::min(static_cast<std::size_t>(std::lround(delay / track.step)), track.X_WA.size() - 1);
  Scene later = scene_;
  later.time += static_cast<double>(count) * track.step;
  later.ego.X_WB = track.X_WA[count];
  later.ego.v_B = going_on->v_B[count];
  later.ego.yaw_rate = going_on->yaw_rate[count];
  if (count > 0) {  // brakes that the ego lets go of have to build up anew
    const Vec2 before_W = rotated(going_on->v_B[count - 1], track.X_WA[count - 1].yaw);
    const Vec2 now_W = rotated(going_on->v_B[count], track.X_WA[count].yaw);
    later.ego.a_B = rotated((1.0 / track.step) * (now_W - before_W), -track.X_WA[count].yaw);
  }
  std::vector<std::optional<EgoMotion>> ways = ways_of(later, plans, tools_);
  for (std::optional<EgoMotion>& way : ways) {
    way = way ? std::optional(continued(*going_on, count, *way)) : std::nullopt;
  }
  return harms_of(ways, plans, later);
}

ExpectedHarm PreparedMotions::harm(const EgoMotion& way) const {
  HeldWay held(scene_, way, *tools_.harm);
  ExpectedHarm expected;
  const std::size_t half = (motions_.size() + 1) / 2;
  const double sum = weight_of(motions_);
  const double sum_of_half = weight_of(motions_.first(half));
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    constexpr int doubts = 2;
    const Told told = told_with_doubts(held, scene_, movers_[k], doubts);
    expected.harm += motions_[k].probability / sum * told.harm;
    expected.contact += motions_[k].probability / sum * told.contact;
    if (k < half) {
      expected.harm_by_half += motions_[k].probability / sum_of_half * told.harm;
      expected.contact_by_half += motions_[k].probability / sum_of_half * told.contact;
    }
  }
  return expected;
}

/// @param from  where the ways begin
std::vector<ExpectedHarm> PreparedMotions::harms_of(
    const std::vector<std::optional<EgoMotion>>& ways, std::span<const manoeuvre::Plan> plans,
    const Scene& from) const {
  std::vector<ExpectedHarm> all;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    all.push_back(ways[i]
                      ? harm(*ways[i])
                      : ExpectedHarm{.plan = plans[i],
                                     .refusal = *manoeuvre::refusal(*tools_.car, plans[i], from)});
    all.back().plan = plans[i];
  }
  return all;
}

void ExpectedHarm::add(const PolicyFacts& facts, double share) {
  if (!facts.drivable()) {
    refusal = facts.refusal();
    return;
  }
  harm += share * facts.outcome().harm;
  contact += share * facts.contact_probability();
}

manoeuvre::Plan least_harmful(std::span<const ExpectedHarm> all) {
  const ExpectedHarm* best = nullptr;
  for (const ExpectedHarm& one : all) {
    if (!one.refusal.empty()) {
      continue;
    }
    const auto outcome_of = [](const ExpectedHarm& each) {
      return collision::Outcome{.harm = each.harm};
    };
    if (best == nullptr ||
        collision::better(outcome_of(one), one.plan.policy, outcome_of(*best), best->plan.policy)) {
      best = &one;
    }
  }
  return best == nullptr ? manoeuvre::Plan{PolicyId::aeb, std::nullopt} : best->plan;
}

}  // namespace saca::preview
