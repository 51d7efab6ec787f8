#include "saca/reason/prompt.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "saca/core/contract.h"
#include "saca/core/names.h"
#include "saca/outcome/describe.h"
#include "saca/outcome/ordering.h"
#include "saca/world/time_to_conflict.h"

namespace saca::reason {
namespace {

using manoeuvre::PolicyId;
using world::Actor;
using world::ActorKind;
using world::Scene;

constexpr std::size_t most_actors = 6;     // of a prompt: each takes about 45 tokens
constexpr double conflict_horizon = 10.0;  // [s], as the risk's
constexpr double trigger_tolerance = 0.5;  // [s], as the trigger's
constexpr double standing = 0.05;          // [m/s]: below it rounds to 0.0

constexpr std::array<std::string_view, manoeuvre::num_policies> policy_words{
    "full braking, lane kept",
    "lane change to the left at constant speed",
    "lane change to the right at constant speed",
    "lane change to the left with braking",
    "lane change to the right with braking",
    "drift to a stop across the lane, facing left",
    "drift to a stop across the lane, facing right",
    "no intervention, lane and speed kept"};

constexpr std::array<std::string_view, intent::num_intentions> intention_words{
    "maintain", "lane change left",  "lane change right",
    "brake",    "brake moving left", "brake moving right",
    "stop",     "cross the lane"};

constexpr std::array<std::string_view, 4> beyond_words{"open ground", "kerb", "barrier", "trees"};

// "-0.0" would be a number that stands nowhere else.
double without_negative_zero(double x, double resolution) {
  return std::abs(x) < resolution / 2.0 ? 0.0 : x;
}

std::string placed(Vec2 p_B) {
  return fmt::format("{:.1f} m {}, {:.1f} m {}", std::abs(p_B.x), p_B.x < 0.0 ? "behind" : "ahead",
                     std::abs(p_B.y), p_B.y < 0.0 ? "right" : "left");
}

std::string moving(Vec2 v_B) {
  const double speed = norm(v_B);
  if (speed < standing) {
    return "standing";
  }
  const bool along = std::abs(v_B.x) >= std::abs(v_B.y);
  const std::string_view direction =
      along ? (v_B.x > 0.0 ? "forwards" : "backwards") : (v_B.y > 0.0 ? "left" : "right");
  return fmt::format("moving {} at {:.1f} m/s", direction, speed);
}

std::string ego_section(const Scene& scene) {
  const Vec2 v_B = scene.ego.v_B;
  return fmt::format(
      "## Ego Vehicle:\n"
      "ID=ego, type=car, position=(0.0, 0.0), velocity=({:.1f}, {:.1f}) m/s, road={}, "
      "grip={:.2f}\n",
      without_negative_zero(v_B.x, 0.1), without_negative_zero(v_B.y, 0.1),
      name(scene.road.topology), scene.grip);
}

std::string obstacle_line(const Actor& actor, Vec2 p_B, double risk) {
  return fmt::format("{}: {:.1f} m long, {:.1f} m wide, {}, risk {:.2f}\n", actor_name(actor),
                     actor.footprint.length, actor.footprint.width, placed(p_B), risk);
}

std::string participant_line(const preview::Situation& situation, std::size_t i, Vec2 p_B) {
  const Scene& scene = situation.scene_at_trigger;
  const Actor& actor = scene.actors[i];
  const auto intention = static_cast<std::size_t>(situation.intentions[i]);
  const auto conflict = world::time_to_conflict(scene, actor, situation.tracks[i], conflict_horizon,
                                                trigger_tolerance);
  // Over ground, seen along the ego's axes.
  const Vec2 v_B = rotated(actor.v_W, -scene.ego.X_WB.yaw);
  return fmt::format(
      "{}: {}, {}{}, {} {:.2f}, TTC {}, risk {:.2f}\n", actor_name(actor), placed(p_B), moving(v_B),
      actor.occluded ? ", not seen now" : "", name_of(situation.intentions[i], intention_words),
      situation.posteriors[i].at(intention), conflict ? fmt::format("{:.1f} s", *conflict) : "none",
      situation.risks[i].risk);
}

// The most dangerous first, then the nearest; the order of the scene decides the rest.
std::vector<std::size_t> told_actors(const preview::Situation& situation) {
  const Scene& scene = situation.scene_at_trigger;
  std::vector<std::size_t> order(scene.actors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto distance = [&](std::size_t i) {
    return norm(scene.actors[i].X_WA.p - scene.ego.X_WB.p);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double risk_a = situation.risks[a].risk;
    const double risk_b = situation.risks[b].risk;
    return risk_a != risk_b ? risk_a > risk_b : distance(a) < distance(b);
  });
  order.resize(std::min(order.size(), most_actors));
  std::sort(order.begin(), order.end());
  return order;
}

std::string actor_sections(const preview::Situation& situation) {
  const Scene& scene = situation.scene_at_trigger;
  const Pose X_BW = inverse(scene.ego.X_WB);
  std::string obstacles;
  std::string participants;
  const std::vector<std::size_t> told = told_actors(situation);
  for (const std::size_t i : told) {
    const Actor& actor = scene.actors[i];
    const Vec2 p_B = X_BW * actor.X_WA.p;
    if (actor.kind == ActorKind::obstacle) {
      obstacles += obstacle_line(actor, p_B, situation.risks[i].risk);
    } else {
      participants += participant_line(situation, i, p_B);
    }
  }
  if (const std::size_t others = scene.actors.size() - told.size(); others > 0) {
    participants += fmt::format("{} more of lower risk.\n", others);
  }
  return "## Obstacles:\n" + (obstacles.empty() ? "No static obstacles detected.\n" : obstacles) +
         "## Traffic Participants:\n" +
         (participants.empty() ? "No traffic participants detected.\n" : participants);
}

std::string road_section(const Scene& scene) {
  const double d = to_lane(scene.road, scene.ego.X_WB).d;
  return fmt::format(
      "## Road:\nleft edge {:.1f} m away, {}; right edge {:.1f} m away, {}\n",
      std::max(scene.road.left_edge - d, 0.0), name_of(scene.road.left_beyond, beyond_words),
      std::max(d - scene.road.right_edge, 0.0), name_of(scene.road.right_beyond, beyond_words));
}

std::string manoeuvre_section(const preview::Situation& situation) {
  std::string text = "## Manoeuvres:\n";
  std::string refused;
  for (const preview::PolicyFacts& facts : situation.facts) {
    if (facts.refusal.empty()) {
      text += policy_line(facts, situation.scene_at_trigger) + '\n';
    } else {
      refused += fmt::format("{}{}", refused.empty() ? "" : ", ", name(facts.plan.policy));
    }
  }
  return refused.empty() ? text : text + "Not possible: " + refused + '\n';
}

// Zeros are digits, and each digit is a token to be read.
std::string harm_text(double harm) {
  constexpr double smallest = 0.5e-4;
  return harm < smallest ? "no harm" : fmt::format("harm {:.4f}", harm);
}

// Where it is not sure whether there is contact, how likely it is.
std::string chance_text(const preview::PolicyFacts& facts) {
  constexpr double sure = 0.005;
  return facts.probability < sure || facts.probability > 1.0 - sure
             ? ""
             : fmt::format(", contact {:.0f} % likely", 100.0 * facts.probability);
}

// The case's own texts are not told: they come from a file.
std::string history_section(const std::optional<memory::Case>& nearest, double similarity) {
  if (!nearest) {
    return "## HISTORICAL SCENARIOS:\nNo historical data is available.\n";
  }
  const auto told = [](PolicyId policy, double harm) {
    return fmt::format("{} {}, {}", manoeuvre::index(policy), name(policy), harm_text(harm));
  };
  return fmt::format(
      "## HISTORICAL SCENARIOS:\nA case {:.0f} % alike: carried out {}; best in hindsight {}\n",
      100.0 * similarity, told(nearest->plan.policy, nearest->harm),
      told(nearest->best, nearest->best_harm));
}

std::string from_mildest() {
  std::array<PolicyId, manoeuvre::num_policies> order = manoeuvre::all_policies;
  std::stable_sort(order.begin(), order.end(), outcome::milder);
  std::string text;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equal = i > 0 && outcome::severity(order[i - 1]) == outcome::severity(order[i]);
    text += fmt::format("{}{}", i == 0 ? "" : equal ? " and " : ", ", manoeuvre::index(order[i]));
  }
  return text;
}

}  // namespace

std::string system_part() {
  std::string text =
      "You choose the manoeuvre that does the least harm in the last seconds before a crash.\n"
      "Policies:\n";
  for (const PolicyId policy : manoeuvre::all_policies) {
    text += fmt::format("{} {}: {}\n", manoeuvre::index(policy), name(policy),
                        policy_words.at(manoeuvre::index(policy)));
  }
  text += fmt::format(
      "Harm counts the people expected to be severely injured or killed, in and outside vehicles "
      "alike. Choose the policy with the least harm. Where harm is equal within {:.4f}, choose the "
      "mildest; from the mildest: {}. Where these are equal too, choose the larger clearance. Do "
      "nothing where nothing threatens. A policy that is not possible cannot be chosen.\n"
      "Risk is from 0 to 1. TTC is the time to the conflict.\n"
      "Reply with \"Scenario Analysis\", then a few short numbered statements that quote the "
      "facts, "
      "and as the last line \"Response to user: N\" with N from 0 to 7.",
      outcome::harm_tie, from_mildest());
  return text;
}

std::string scene_part(const preview::Situation& situation,
                       const std::optional<memory::Case>& nearest, double similarity) {
  const std::size_t num_actors = situation.scene_at_trigger.actors.size();
  expects(situation.intentions.size() == num_actors && situation.posteriors.size() == num_actors &&
              situation.risks.size() == num_actors && situation.tracks.size() == num_actors,
          "one intention, posterior, risk and track per actor");
  expects(!nearest || (similarity >= 0.0 && similarity <= 1.0), "similarity in [0, 1]");
  return "AUTONOMOUS DRIVING COLLISION AVOIDANCE SCENARIO\n" +
         ego_section(situation.scene_at_trigger) + actor_sections(situation) +
         road_section(situation.scene_at_trigger) + manoeuvre_section(situation) +
         history_section(nearest, similarity);
}

std::string policy_line(const preview::PolicyFacts& facts, const world::Scene& scene) {
  const PolicyId policy = facts.plan.policy;
  const std::string label = fmt::format("{} {}: ", manoeuvre::index(policy), name(policy));
  if (!facts.refusal.empty()) {
    return label + "not possible: " + facts.refusal;
  }
  const bool oncoming = (side(policy) > 0 && scene.road.oncoming_left) ||
                        (side(policy) < 0 && scene.road.oncoming_right);
  return fmt::format("{}{}{}, {}{}", label, outcome::describe(facts.outcome, scene),
                     chance_text(facts), harm_text(facts.outcome.harm),
                     oncoming ? ", oncoming lane" : "");
}

}  // namespace saca::reason
