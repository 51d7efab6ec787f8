// Longer than 400 lines: all that a prompt says stands here: whoever changes a line of it has the
// model trained anew.
#include "saca/thinking/language_model/prompt.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/forecast/admissible.h"
#include "saca/thinking/language_model/token_bound.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;
using world::Actor;
using world::ActorKind;
using world::Scene;

constexpr std::string_view ego_name = "ego";
constexpr std::string_view least_harm_head = "Least harm:\n";
constexpr std::string_view more_harm_head = "More harm:\n";
constexpr std::string_view risk_label = ", risk ";
constexpr double conflict_horizon = 10.0;  // [s], as the risk's
constexpr double trigger_tolerance = 0.5;  // [s], as the trigger's
constexpr double standing = 0.05;          // [m/s]: below it rounds to 0.0
// What is not needed is told while a prompt has at most so many (tokens_at_most): three prompts are
// read within some three seconds by a single core at 285 tokens/s.
constexpr int enough_tokens = 305;

constexpr std::array<std::string_view, manoeuvre::num_policies> policy_words{
    "braking, lane kept",
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

constexpr std::array<std::string_view, world::num_cue_kinds> cue_words{
    "school zone",
    "bus at a stop with open doors",
    "row of parked vans",
    "work zone",
    "siren of an emergency vehicle that is not seen",
    "low sun",
    "wet leaves on the road"};

// Metres or metres per second, at least 0. Each digit is a token to be read: from ten on none
// stands behind the point.
std::string measured(double x) {
  constexpr double least_rounded_to_ten = 9.95;
  return x < least_rounded_to_ten ? fmt::format("{:.1f}", x) : fmt::format("{:.0f}", x);
}

// Two digits that count, and at most three behind the point.
std::string harm_digits(double harm) {
  constexpr double least_rounded_to_a_tenth = 0.0995;
  constexpr double least_rounded_to_one = 0.995;
  return harm < least_rounded_to_a_tenth ? fmt::format("{:.3f}", harm)
         : harm < least_rounded_to_one   ? fmt::format("{:.2f}", harm)
                                         : fmt::format("{:.1f}", harm);
}

std::string placed(Vec2 p_B) {
  return fmt::format("{} m {}, {} m {}", measured(std::abs(p_B.x)),
                     p_B.x < 0.0 ? "behind" : "ahead", measured(std::abs(p_B.y)),
                     p_B.y < 0.0 ? "right" : "left");
}

std::string moving(Vec2 v_B) {
  const double speed = norm(v_B);
  if (speed < standing) {
    return "standing";
  }
  const bool along = std::abs(v_B.x) >= std::abs(v_B.y);
  const std::string_view direction =
      along ? (v_B.x > 0.0 ? "forwards" : "backwards") : (v_B.y > 0.0 ? "left" : "right");
  return fmt::format("moving {} at {} m/s", direction, measured(speed));
}

std::string ego_line(const Scene& scene) {
  const Vec2 v_B = scene.ego.v_B;
  const std::string sliding = std::abs(v_B.y) < standing
                                  ? ""
                                  : fmt::format(", sliding {} m/s {}", measured(std::abs(v_B.y)),
                                                v_B.y < 0.0 ? "right" : "left");
  const std::string_view sign = v_B.x <= -standing ? "-" : "";  // "-0.0" would be no number
  return fmt::format("{}: {}{} m/s{}, {}, grip {:.2f}\n", ego_name, sign, measured(std::abs(v_B.x)),
                     sliding, name(scene.road.topology), scene.grip);
}

std::string obstacle_line(const Actor& actor, Vec2 p_B, double risk) {
  return fmt::format("{}: {} m long, {} m wide, {}{}{:.2f}\n", actor_name(actor),
                     measured(actor.footprint.length), measured(actor.footprint.width), placed(p_B),
                     risk_label, risk);
}

std::string participant_line(const preview::Situation& situation, std::size_t i, Vec2 p_B) {
  const Scene& scene = situation.scene_at_trigger;
  const Actor& actor = scene.actors[i];
  const auto intention = static_cast<std::size_t>(situation.intentions[i]);
  const auto conflict = world::time_to_conflict(scene, actor, situation.tracks[i], conflict_horizon,
                                                trigger_tolerance);
  // Over ground, seen along the ego's axes.
  const Vec2 v_B = rotated(actor.v_W, -scene.ego.X_WB.yaw);
  return fmt::format("{}: {}, {}{}, {} {:.2f}{}{}{:.2f}\n", actor_name(actor), placed(p_B),
                     moving(v_B), actor.occluded ? ", not seen now" : "",
                     name_of(situation.intentions[i], intention_words),
                     situation.posteriors[i].at(intention),
                     conflict ? fmt::format(", TTC {:.1f} s", *conflict) : "", risk_label,
                     situation.risks[i].risk);
}

bool is_hit_by_nothing(const preview::Situation& situation, std::size_t actor) {
  const preview::PolicyFacts& nothing =
      situation.facts[manoeuvre::index(PolicyId::no_intervention)];
  return nothing.drivable() && nothing.outcome().contact &&
         nothing.outcome().contact->actor == actor;
}

// Who is hit if nothing is done comes first, then the most dangerous, then the nearest; the order
// of the scene decides the rest.
std::vector<std::size_t> by_danger(const preview::Situation& situation) {
  const Scene& scene = situation.scene_at_trigger;
  std::vector<std::size_t> order(scene.actors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    return std::tuple(!is_hit_by_nothing(situation, i), -situation.risks[i].risk,
                      norm(scene.actors[i].X_WA.p - scene.ego.X_WB.p));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

// The best forecast first; refused policies are not among them.
std::vector<std::size_t> by_forecast(const preview::Situation& situation) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < situation.facts.size(); ++k) {
    if (situation.facts[k].drivable()) {
      order.push_back(k);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return preview::better(situation.facts[a], situation.facts[b]);
  });
  return order;
}

/// What may be left out of a prompt.
struct Detail {
  bool of_actor = false;  ///< its line; else how the policy comes to its harm
  std::size_t index = 0;  ///< of the actor or policy
};

// The weightiest first: the two who are most dangerous, then two policies and an actor in turns.
std::vector<Detail> by_weight(const preview::Situation& situation) {
  const std::vector<std::size_t> actors = by_danger(situation);
  const std::vector<std::size_t> policies = by_forecast(situation);
  std::vector<Detail> order;
  auto actor = actors.begin();
  auto policy = policies.begin();
  const auto add_actor = [&] {
    if (actor != actors.end()) {
      order.push_back({true, *actor++});
    }
  };
  const auto add_policy = [&] {
    if (policy != policies.end()) {
      order.push_back({false, *policy++});
    }
  };
  add_actor();
  while (actor != actors.end() || policy != policies.end()) {
    add_actor();
    add_policy();
    add_policy();
  }
  return order;
}

/// How much of a situation is told.
struct Depth {
  std::vector<bool> actor;                               ///< whether it has a line, one per actor
  std::array<bool, manoeuvre::num_policies> in_whole{};  ///< or without how it comes to the harm
};

Depth with(Depth told, const Detail& detail) {
  if (detail.of_actor) {
    told.actor[detail.index] = true;
  } else {
    told.in_whole.at(detail.index) = true;
  }
  return told;
}

std::string actor_line(const preview::Situation& situation, std::size_t i) {
  const Scene& scene = situation.scene_at_trigger;
  const Actor& actor = scene.actors[i];
  const Vec2 p_B = inverse(scene.ego.X_WB) * actor.X_WA.p;
  return actor.kind == ActorKind::obstacle ? obstacle_line(actor, p_B, situation.risks[i].risk)
                                           : participant_line(situation, i, p_B);
}

std::string edge_text(double way, world::Beyond beyond, bool is_oncoming) {
  const std::string there =
      beyond == world::Beyond::unmarked ? "" : fmt::format(", {}", beyond_text(beyond));
  return fmt::format("{} m{}{}", edge_distance(way), there, is_oncoming ? ", oncoming lane" : "");
}

std::string road_lines(const Scene& scene) {
  const world::Road& road = scene.road;
  const double d = to_lane(road, scene.ego.X_WB).d;
  std::string text =
      fmt::format("left edge {}; right edge {}\n",
                  edge_text(road.left_edge - d, road.left_beyond, road.oncoming_left),
                  edge_text(d - road.right_edge, road.right_beyond, road.oncoming_right));
  for (const world::Cue& cue : scene.cues) {
    text += fmt::format("{}, {}\n", cue_text(cue.kind), cue_place(cue, scene));
  }
  return text;
}

std::string chance_text(const preview::PolicyFacts& facts) {
  return fmt::format(", contact {:.0f} % likely", 100.0 * facts.contact_probability());
}

std::string called(const collision::Contact& contact, const Scene& scene) {
  return contact.actor ? actor_name(scene.actors[*contact.actor]) : "the road";
}

// Whom a policy meets; in whole also how fast and who is met after him.
std::string contact_text(const collision::Outcome& outcome, const Scene& scene, bool in_whole) {
  const collision::Contact& contact = *outcome.contact;
  std::string text = (contact.actor ? "hits " : "leaves ") + called(contact, scene);
  if (in_whole) {
    text += fmt::format(" at {} m/s", measured(contact.relative_speed));
    for (const collision::Contact& later : outcome.later) {
      text += ", then " + called(later, scene);
    }
  }
  return text;
}

// Whether a line tells how likely contact is: where that is not as good as certain, or where who
// stays clear does harm all the same. Of an edge it tells nothing.
bool has_chance(const preview::PolicyFacts& facts, bool in_whole) {
  constexpr double sure = 0.05;
  constexpr double much = 0.05;  // [harm]
  const collision::Outcome& outcome = facts.outcome();
  if (!outcome.contact) {  // in short as well: luck is not the same as certainty
    return facts.contact_probability() >= sure || outcome.harm >= much;
  }
  return in_whole && outcome.contact->actor && facts.contact_probability() <= 1.0 - sure;
}

// A policy's forecast. To what speed it brakes is not told: each word of a prompt takes time.
std::string forecast_line(const preview::PolicyFacts& facts, const Scene& scene, bool in_whole) {
  const collision::Outcome& outcome = facts.outcome();
  std::string how;
  if (outcome.contact) {
    how = contact_text(outcome, scene, in_whole);
  } else {
    how = in_whole ? fmt::format("clear by {} m", measured(outcome.clearance)) : "clear";
  }
  return policy_label(facts.plan) + ": " + how +
         (has_chance(facts, in_whole) ? chance_text(facts) : "") + ", " + prompt_harm(outcome.harm);
}

/// Every line that may stand in a prompt.
struct Lines {
  std::vector<std::string> actor;
  std::array<std::string, manoeuvre::num_policies> in_whole;  ///< empty: cannot be driven
  std::array<std::string, manoeuvre::num_policies> in_short;
};

Lines lines_of(const preview::Situation& situation) {
  const Scene& scene = situation.scene_at_trigger;
  Lines lines;
  lines.actor.resize(scene.actors.size());
  for (std::size_t i = 0; i < lines.actor.size(); ++i) {
    lines.actor[i] = actor_line(situation, i);
  }
  for (std::size_t k = 0; k < situation.facts.size(); ++k) {
    const preview::PolicyFacts& facts = situation.facts[k];
    if (facts.drivable()) {
      lines.in_whole.at(k) = forecast_line(facts, scene, true) + '\n';
      lines.in_short.at(k) = forecast_line(facts, scene, false) + '\n';
    }
  }
  return lines;
}

std::string actor_lines(const preview::Situation& situation, const Lines& lines,
                        const Depth& depth) {
  if (lines.actor.empty()) {
    return "nobody else\n";
  }
  std::string text;
  std::size_t others = 0;
  double least_told = 1.0;  // risk
  double most_untold = 0.0;
  for (std::size_t i = 0; i < depth.actor.size(); ++i) {
    const double risk = situation.risks[i].risk;
    if (depth.actor[i]) {
      text += lines.actor[i];
      least_told = std::min(least_told, risk);
    } else {
      ++others;
      most_untold = std::max(most_untold, risk);
    }
  }
  if (others > 0) {  // who is hit if nothing is done is told whatever his risk
    text += fmt::format("{} more{}\n", others, most_untold <= least_told ? " of lower risk" : "");
  }
  return text;
}

// The best forecast first, so that nobody who reads has to compare numbers.
std::string manoeuvre_lines(const preview::Situation& situation, const Lines& lines,
                            const Depth& depth) {
  const memory::Policies may = admissible(situation.facts);
  std::string least(least_harm_head);
  std::string more(more_harm_head);
  for (const std::size_t k : by_forecast(situation)) {
    (may.test(k) ? least : more) += (depth.in_whole.at(k) ? lines.in_whole : lines.in_short).at(k);
  }
  return (least == least_harm_head ? "" : least) + (more == more_harm_head ? "" : more);
}

// The case's own texts are not told: they come from a file. What it teaches stands in its numbers:
// how often it was met, and what was expected where it went otherwise.
std::string history_line(const std::optional<memory::Case>& nearest, double similarity,
                         bool with_lesson) {
  if (!nearest) {
    return "no case is alike\n";
  }
  const auto policy_harm = [](PolicyId policy, double harm) {
    return fmt::format("{} {}, {}", manoeuvre::index(policy), name(policy), prompt_harm(harm));
  };
  if (memory::is_hearsay(*nearest)) {
    return fmt::format("A case {:.0f} % alike: somebody says that {} {} is best\n",
                       100.0 * similarity, manoeuvre::index(nearest->best), name(nearest->best));
  }
  const PolicyId done = nearest->plan.policy;
  std::string often;
  std::string expected;
  if (with_lesson && nearest->count > 1) {
    often = fmt::format(", met {} times", nearest->count);
  }
  if (with_lesson && nearest->told && nearest->told->at(manoeuvre::index(done))) {
    const double harm = *nearest->told->at(manoeuvre::index(done));
    if (std::abs(harm - nearest->harm) > memory::as_good) {
      expected = fmt::format(" ({} expected)", harm_digits(harm));
    }
  }
  const std::string what_was_done = policy_harm(done, nearest->harm) + expected;
  return fmt::format(
      "A case {:.0f} % alike{}:{} best in hindsight {}\n", 100.0 * similarity, often,
      done == nearest->best ? "" : " carried out " + what_was_done + ";",
      done == nearest->best ? what_was_done : policy_harm(nearest->best, nearest->best_harm));
}

std::string from_mildest() {
  std::array<PolicyId, manoeuvre::num_policies> order = manoeuvre::all_policies;
  std::stable_sort(order.begin(), order.end(), collision::milder);
  std::string text;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equal = i > 0 && collision::severity(order[i - 1]) == collision::severity(order[i]);
    text += fmt::format("{}{}", i == 0 ? "" : equal ? " and " : ", ", manoeuvre::index(order[i]));
  }
  return text;
}

std::string rendered(const preview::Situation& situation, const Lines& lines, const Depth& depth,
                     const std::string& history) {
  const Scene& scene = situation.scene_at_trigger;
  return ego_line(scene) + actor_lines(situation, lines, depth) + road_lines(scene) +
         manoeuvre_lines(situation, lines, depth) + history;
}

}  // namespace

bool leads_into_oncoming(const world::Road& road, PolicyId policy) {
  const int side = manoeuvre::side(policy);
  return (side > 0 && road.oncoming_left) || (side < 0 && road.oncoming_right);
}

memory::Policies admissible(const preview::AllFacts& facts) {
  memory::Policies policies;
  const double least = preview::least_harm(facts);
  const preview::PolicyFacts& braking = facts[manoeuvre::index(PolicyId::aeb)];
  const double most =
      forecast::admissible_harm(least, braking.drivable() ? braking.outcome().harm : least);
  for (const preview::PolicyFacts& one : facts) {
    policies.set(manoeuvre::index(one.plan.policy), one.drivable() && one.outcome().harm <= most);
  }
  return policies;
}

std::string system_part(const collision::HarmModel& harm) {
  std::string text =
      "You choose the manoeuvre that does the least harm in the last seconds before a crash.\n"
      "Policies:\n";
  for (const PolicyId policy : manoeuvre::all_policies) {
    text += fmt::format("{} {}: {}\n", manoeuvre::index(policy), name(policy),
                        policy_words.at(manoeuvre::index(policy)));
  }
  text += fmt::format(
      "Harm counts the people expected to be severely injured ({:g} each) or killed ({:g} each), "
      "in and outside vehicles alike. It is a forecast, the best first: under \"Least harm\" stand "
      "the policies within {:.3f} of the least, or {:.0f} % of what AEB has above it, which cannot "
      "be told apart. What is not listed cannot be driven. Choose the surest of those that cannot "
      "be told apart: whom it may hit and how likely, what lies beyond the edge, how the most "
      "alike case ended. Else the mildest; from the mildest: {}. Do nothing where that is among "
      "them: it is looked at again.\n"
      "Places are seen from the ego. Risk is from 0 to 1. TTC is the time to the conflict. An "
      "oncoming lane belongs to oncoming traffic; policies to that side enter it.\n"
      "Reply with \"Scenario Analysis\", then a few short numbered statements that quote the "
      "facts, and as the last line \"Response to user: N\" with N from 0 to 7.",
      harm.severe_weight, harm.severe_weight + harm.killed_weight, forecast::least_tolerance,
      100.0 * forecast::tolerated_share, from_mildest());
  return text;
}

std::string scene_part(const preview::Situation& situation,
                       const std::optional<memory::Case>& nearest, double similarity) {
  const std::size_t num_actors = situation.scene_at_trigger.actors.size();
  expects(situation.intentions.size() == num_actors && situation.posteriors.size() == num_actors &&
              situation.risks.size() == num_actors && situation.tracks.size() == num_actors,
          "one intention, posterior, risk and track per actor");
  expects(!nearest || (similarity >= 0.0 && similarity <= 1.0), "similarity in [0, 1]");
  const std::string history = history_line(nearest, similarity, false);
  const Lines lines = lines_of(situation);
  const auto fits = [&](const std::string& text) { return tokens_at_most(text) <= enough_tokens; };
  Depth told{.actor = std::vector<bool>(num_actors), .in_whole = {}};
  bool is_first = true;          // who is most dangerous is told in any case
  bool actors_left_out = false;  // nobody is told who is less dangerous than somebody untold
  for (const Detail& detail : by_weight(situation)) {
    if (detail.of_actor && actors_left_out) {
      continue;
    }
    Depth more = with(told, detail);
    if ((is_first && detail.of_actor) || fits(rendered(situation, lines, more, history))) {
      told = std::move(more);
    } else if (detail.of_actor) {
      actors_left_out = true;
    }
    is_first = false;
  }
  const std::string with_lesson =
      rendered(situation, lines, told, history_line(nearest, similarity, true));
  return fits(with_lesson) ? with_lesson : rendered(situation, lines, told, history);
}

std::string without_facts(const std::string& scene_part) {
  std::string rest;
  for (std::size_t begin = 0; begin < scene_part.size();) {
    const std::size_t end = std::min(scene_part.find('\n', begin), scene_part.size() - 1) + 1;
    const std::string_view line = std::string_view(scene_part).substr(begin, end - begin);
    const bool of_a_policy =
        std::any_of(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(),
                    [&](PolicyId policy) { return is_line_of(line, policy); });
    if (!of_a_policy && line != least_harm_head && line != more_harm_head) {
      rest += line;
    }
    begin = end;
  }
  return rest;
}

std::string without_risks(const std::string& scene_part) {
  static constexpr std::string_view digits = "0123456789.";
  std::string rest;
  std::size_t from = 0;
  for (std::size_t at = scene_part.find(risk_label); at != std::string::npos;
       at = scene_part.find(risk_label, at + 1)) {
    const std::size_t end = scene_part.find_first_not_of(digits, at + risk_label.size());
    if (end != std::string::npos && scene_part[end] == '\n') {
      rest.append(scene_part, from, at - from);
      from = end;
    }
  }
  return rest.append(scene_part, from, std::string::npos);
}

std::string_view cue_text(world::CueKind kind) {
  return name_of(kind, cue_words);
}

std::string cue_place(const world::Cue& cue, const Scene& scene) {
  return placed(inverse(scene.ego.X_WB) * cue.p_W);
}

std::string prompt_policy(const preview::PolicyFacts& facts, const world::Scene& scene) {
  return forecast_line(facts, scene, true);
}

std::string edge_distance(double way) {
  return measured(std::max(way, 0.0));
}

std::string policy_label(const manoeuvre::Plan& plan) {
  return manoeuvre::plan_text({.policy = plan.policy, .strength = plan.strength});
}

std::string policy_line(const preview::PolicyFacts& facts, const world::Scene& scene) {
  const std::string line = manoeuvre::plan_text(facts.plan);
  if (!facts.drivable()) {
    return line + ": not possible: " + facts.refusal();
  }
  constexpr double sure = 0.005;
  const double chance = facts.contact_probability();
  const collision::Outcome& outcome = facts.outcome();
  return line + ": " +
         (outcome.contact ? rollout::describe(outcome, scene)
                          : fmt::format("clear by {:.1f} m", outcome.clearance)) +
         (chance < sure || chance > 1.0 - sure ? "" : chance_text(facts)) + ", " +
         harm_text(outcome.harm);
}

std::string harm_text(double harm) {
  constexpr double smallest = 0.5e-4;
  return harm < smallest ? "no harm" : fmt::format("harm {:.4f}", harm);
}

std::string prompt_harm(double harm) {
  return harm < prompt_no_harm ? "no harm" : "harm " + harm_digits(harm);
}

std::string_view beyond_text(world::Beyond beyond) {
  constexpr std::array<std::string_view, 4> words{"open ground", "kerb", "barrier", "trees"};
  return name_of(beyond, words);
}

bool is_line_of(std::string_view line, PolicyId policy) {
  const std::string label = fmt::format("{} {}", manoeuvre::index(policy), name(policy));
  return line.starts_with(label) && line.size() > label.size() &&
         (line[label.size()] == ':' || line[label.size()] == ' ');
}

bool is_line_of_ego(std::string_view line) {
  return line.starts_with(ego_name);
}

bool is_line_of_case(std::string_view line) {
  return line.starts_with("A case ");
}

}  // namespace saca::language_model
