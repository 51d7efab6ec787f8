#include "saca/thinking/language_model/statements.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/prompt_lines.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;
using preview::PolicyFacts;
using world::Actor;

/// A contact less likely than this is no threat.
constexpr double unlikely = 0.05;
/// An edge that is nearer than this is worth a word [m]: a lane's width.
constexpr double near_edge = 3.5;

/// The best by forecast of those that can be driven and are wanted; nullopt: there is none.
template <class Wanted>
std::optional<PolicyId> best_where(const preview::AllFacts& facts, const Wanted& wanted) {
  std::optional<PolicyId> best;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const PolicyFacts& one = facts[manoeuvre::index(policy)];
    if (one.drivable() && wanted(one) &&
        (!best || preview::better(one, facts[manoeuvre::index(*best)]))) {
      best = policy;
    }
  }
  return best;
}

bool may_touch(const PolicyFacts& facts) {
  return facts.outcome().contact.has_value() || facts.contact_probability() > unlikely;
}

std::string called(PolicyId policy) {
  return std::string(name(policy));
}

std::string after_comma(const std::string& piece) {
  return piece.empty() ? "" : ", " + piece;
}

}  // namespace

bool Statements::is_safe() const {
  const PolicyFacts& nothing = facts(PolicyId::no_intervention);
  return nothing.drivable() && !may_touch(nothing);
}

bool Statements::is_told(std::size_t actor) const {
  const auto& actors = situation_.scene_at_trigger.actors;
  return !rest_of_line(prompt_, actor_name(actors[actor]) + ": ").empty();
}

std::optional<std::size_t> Statements::most_dangerous() const {
  const PolicyFacts& nothing = facts(PolicyId::no_intervention);
  if (nothing.drivable() && nothing.outcome().contact) {
    const std::optional<std::size_t> hit = nothing.outcome().contact->actor;
    if (hit && is_told(*hit)) {
      return hit;
    }
  }
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < situation_.risks.size(); ++i) {
    if (is_told(i) && (!most || situation_.risks[i].risk > situation_.risks[*most].risk)) {
      most = i;
    }
  }
  return most;
}

std::vector<std::string> Statements::addresses() const {
  return is_safe() ? std::vector<std::string>{"Nearest to danger is ", "Most to be watched is "}
                   : std::vector<std::string>{"Most dangerous is ", "The danger is "};
}

RoadUserPieces Statements::pieces_of(std::size_t actor) const {
  const world::Scene& scene = situation_.scene_at_trigger;
  const Actor& it = scene.actors[actor];
  const std::string name = actor_name(it);
  const ActorLine told = read_actor_line(rest_of_line(prompt_, name + ": "));
  constexpr double half_lane = 1.75;  // [m]
  const bool beside = std::abs((inverse(scene.ego.X_WB) * it.X_WA.p).y) > half_lane;
  return {.who = name + ", " + told.along,
          .beside = beside ? after_comma(told.across) : "",
          .risk = after_comma(told.risk),
          .intention = after_comma(told.intention),
          .conflict = after_comma(told.conflict),
          .unprotected = collision::unprotected(it.kind) ? ", unprotected" : ""};
}

std::string Statements::end_of(PolicyId policy) const {
  if (!facts(policy).drivable()) {
    return called(policy) + " is not possible";
  }
  const std::string_view told = rest_of_line(prompt_, policy_label(facts(policy).plan) + ": ");
  if (told.empty()) {
    return "";
  }
  const std::string how(told.substr(0, std::min(told.find(','), told.find(" at "))));
  return called(policy) + (how.starts_with("clear") ? " is " : " ") + how;
}

std::string Statements::end_beside(PolicyId policy, std::size_t actor) const {
  const PolicyFacts& its = facts(policy);
  if (!its.drivable()) {
    return "";
  }
  if (!its.outcome().contact) {
    return end_of(policy);
  }
  return its.outcome().contact->actor == actor ? called(policy) + " hits it" : "";
}

std::string Statements::with_harm(PolicyId policy) const {
  const PolicyFacts& its = facts(policy);
  return its.drivable() && its.outcome().contact ? ", " + prompt_harm(its.outcome().harm) : "";
}

std::vector<std::string> Statements::warnings() const {
  const world::Cue* const cue = next_cue();
  if (cue == nullptr) {
    return {};
  }
  const std::string what =
      fmt::format("The {} {} ", cue_text(cue->kind), cue_place(*cue, situation_.scene_at_trigger));
  return cue->kind == world::CueKind::wet_leaves
             ? std::vector{what + "may leave less grip", what + "may be slippery"}
             : std::vector{what + "may hide somebody", what + "may mean somebody who is not seen"};
}

/// Whether the most alike case tells what was best: of one that somebody told nobody knows.
bool Statements::has_hindsight() const {
  return nearest_ && !memory::is_hearsay(*nearest_);
}

std::vector<Remark> Statements::remarks() const {
  std::vector<Remark> all;
  for (const int side : {1, -1}) {
    add_side(side, all);
  }
  if (has_hindsight()) {
    const bool did_worse = nearest_->plan.policy != nearest_->best &&
                           nearest_->harm > nearest_->best_harm + memory::as_good;
    const std::string how =
        called(nearest_->best) + " was best in hindsight" +
        (did_worse ? ", though " + called(nearest_->plan.policy) + " was carried out" : "");
    all.push_back({{"In the most alike case " + how, "In the nearest case " + how}});
  }
  return all;
}

void Statements::add_side(int side, std::vector<Remark>& all) const {
  const world::Road& road = situation_.scene_at_trigger.road;
  const std::string word = side > 0 ? "left" : "right";
  const std::optional<PolicyId> best = best_to(side);
  if (!best) {
    const bool can_go = std::any_of(
        situation_.facts.begin(), situation_.facts.end(), [side](const PolicyFacts& one) {
          return manoeuvre::side(one.plan.policy) == side && one.drivable();
        });
    const std::string what = can_go ? " is blocked" : " is not possible";
    all.push_back({{"The way to the " + word + what, "All to the " + word + what}, side, true});
  } else if (const std::string end = end_of(*best); !end.empty()) {
    const std::string what = end + with_harm(*best);
    all.push_back({{"To the " + word + " " + what, "On the " + word + " " + what}, side});
  }
  if ((side > 0 ? road.oncoming_left : road.oncoming_right) && best) {
    all.push_back({{"To the " + word + " is an oncoming lane"}});
  }
  const double d = to_lane(road, situation_.scene_at_trigger.ego.X_WB).d;
  const double way = side > 0 ? road.left_edge - d : d - road.right_edge;
  const world::Beyond beyond = side > 0 ? road.left_beyond : road.right_beyond;
  if (way < near_edge && beyond != world::Beyond::unmarked) {
    all.push_back(
        {{fmt::format("Beyond the {} edge, {} m away, {} {}", word, edge_distance(way),
                      beyond == world::Beyond::trees ? "are" : "is a", beyond_text(beyond))}});
  }
}

/// The nearest cue that is ahead; nullptr: none is.
const world::Cue* Statements::next_cue() const {
  const world::Cue* next = nullptr;
  for (const world::Cue& cue : situation_.scene_at_trigger.cues) {
    if (place_of(cue).x > 0.0 && (next == nullptr || place_of(cue).x < place_of(*next).x)) {
      next = &cue;
    }
  }
  return next;
}

/// Seen from the ego [m].
Vec2 Statements::place_of(const world::Cue& cue) const {
  return inverse(situation_.scene_at_trigger.ego.X_WB) * cue.p_W;
}

/// +1: to the left of our lane, -1: to the right; 0: on it, or it is the road itself.
int Statements::side_of(const world::Cue& cue) const {
  constexpr double half_lane = 1.0;  // [m], and a person's half
  const double y = place_of(cue).y;
  return cue.kind == world::CueKind::wet_leaves || std::abs(y) < half_lane ? 0 : y > 0.0 ? 1 : -1;
}

/// The best policy to a side that touches nobody for certain; nullopt: all are blocked.
std::optional<PolicyId> Statements::best_to(int side) const {
  return best_where(situation_.facts, [side](const PolicyFacts& one) {
    return manoeuvre::side(one.plan.policy) == side && !one.outcome().contact;
  });
}

bool Statements::is_alone() const {
  return admissible(situation_.facts).count() == 1;
}

std::optional<PolicyId> Statements::next_best(PolicyId choice) const {
  return best_where(situation_.facts,
                    [choice](const PolicyFacts& one) { return one.plan.policy != choice; });
}

std::string Statements::conclusion(PolicyId choice, const std::optional<PolicyId>& other) const {
  const std::string chosen = "So " + called(choice) + ": ";
  if (!other) {
    return chosen + "it alone is possible";
  }
  return chosen + (is_alone() ? "least harm, next " : "as good as ") + called(*other);
}

std::vector<std::string> Statements::advantages(PolicyId choice, PolicyId other) const {
  const PolicyFacts& mine = facts(choice);
  const PolicyFacts& theirs = facts(other);
  if (is_alone()) {
    return {", " + prompt_harm(theirs.outcome().harm)};
  }
  std::vector<std::string> all;
  const auto add_if = [&](bool so, std::string what) {
    if (so) {
      all.push_back(std::move(what));
    }
  };
  add_if(collision::milder(choice, other), ", and milder");
  add_if(choice == PolicyId::aeb && other == PolicyId::no_intervention,
         ", and less speed harms less if a forecast errs");
  if (const world::Cue* const cue = next_cue()) {
    add_if(side_of(*cue) != 0 && manoeuvre::side(other) == side_of(*cue) &&
               manoeuvre::side(choice) != side_of(*cue),
           fmt::format(", and keeps away from the {}", cue_text(cue->kind)));
  }
  add_if(mine.contact_probability() + unlikely < theirs.contact_probability(),
         ", and touches somebody less often");
  const world::Road& road = situation_.scene_at_trigger.road;
  add_if(leads_into_oncoming(road, other) && !leads_into_oncoming(road, choice),
         ", and stays out of the oncoming lane");
  add_if(has_hindsight() && nearest_->best == choice, ", and this was best in the most alike case");
  return all;
}

}  // namespace saca::language_model
