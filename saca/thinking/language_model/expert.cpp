#include "saca/thinking/language_model/expert.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/prompt_lines.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;
using preview::AllFacts;
using preview::PolicyFacts;
using world::Actor;

/// A contact less likely than this is no threat.
constexpr double unlikely = 0.05;
/// An edge that is nearer than this is worth a word [m]: a lane's width.
constexpr double near_edge = 3.5;

const PolicyFacts& of(const AllFacts& facts, PolicyId policy) {
  return facts[manoeuvre::index(policy)];
}

/// The best by forecast of those that can be driven and are wanted; nullopt: there is none.
template <class Wanted>
std::optional<PolicyId> best_where(const AllFacts& facts, const Wanted& wanted) {
  std::optional<PolicyId> best;
  for (const PolicyId policy : manoeuvre::all_policies) {
    const PolicyFacts& one = of(facts, policy);
    if (one.drivable() && wanted(one) && (!best || preview::better(one, of(facts, *best)))) {
      best = policy;
    }
  }
  return best;
}

bool may_touch(const PolicyFacts& facts) {
  return facts.outcome().contact.has_value() || facts.contact_probability() > unlikely;
}

/// What may be left out of a reply.
enum class Piece : std::uint8_t {
  cue,          ///< a statement
  beside,       ///< ", 6.4 m left"
  how_sure,     ///< ", maintain 0.94"
  unprotected,  ///< ", unprotected"
  ends,         ///< "AEB hits car2": how somebody else fares than who threatens
  harm,         ///< ", harm 0.5943"
  margin,       ///< ", harm 0.0724", of the next best
  reason,       ///< a statement
  address       ///< "The danger is "
};
constexpr std::size_t num_pieces = 9;

/// What a reply is put together from. Empty: does not apply.
struct Arguments {
  std::string who;         ///< "truck1, 16.0 m ahead"
  std::string end;         ///< ": NI hits it"
  std::string conclusion;  ///< a statement
  std::array<std::string, num_pieces> pieces;

  std::string& operator[](Piece piece) { return pieces.at(static_cast<std::size_t>(piece)); }
};

/// Puts arguments together and words them.
class Speaker {
 public:
  Speaker(const preview::Situation& situation, std::string_view scene_part,
          const std::optional<memory::Case>& nearest, PolicyId choice, std::mt19937_64& random)
      : situation_(situation),
        facts_(situation.facts),
        prompt_(scene_part),
        nearest_(nearest),
        choice_(choice),
        random_(random) {}

  std::string reply(int most_tokens) {
    const Arguments arguments = this->arguments();
    std::array<Piece, num_pieces> order{Piece::cue,    Piece::beside, Piece::how_sure,
                                        Piece::ends,   Piece::harm,   Piece::unprotected,
                                        Piece::margin, Piece::reason, Piece::address};
    std::shuffle(order.begin() + 1, order.end() - 1, random_);
    std::bitset<num_pieces> told;
    std::string text = composed(arguments, told);
    for (const Piece piece : order) {
      std::bitset<num_pieces> more = told;
      more.set(static_cast<std::size_t>(piece));
      std::string longer = composed(arguments, more);
      if (tokens_at_most(longer) <= most_tokens) {
        told = more;
        text = std::move(longer);
      }
    }
    return text;
  }

 private:
  template <class... Words>
  std::string one_of(const Words&... words) {
    std::array<std::string, sizeof...(words)> all{std::string(words)...};
    return all.at(std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random_));
  }
  bool perhaps() { return std::uniform_int_distribution<int>(0, 1)(random_) == 1; }

  [[nodiscard]] static std::string called(PolicyId policy) { return std::string(name(policy)); }
  /// "is clear by 0.6 m", "hits car1": what the prompt has of it, in short.
  [[nodiscard]] std::string end_of(PolicyId policy) const {
    const PolicyFacts& facts = of(facts_, policy);
    if (!facts.drivable()) {
      return "is not possible";
    }
    const std::string_view told = rest_of_line(prompt_, manoeuvre::plan_text(facts.plan) + ": ");
    const std::string how(told.substr(0, std::min(told.find(','), told.find(" with "))));
    return how.starts_with("clear") ? "is " + how : how;
  }
  /// ", harm 0.0125" of what is not clear; empty: it is.
  [[nodiscard]] std::string with_harm(PolicyId policy) const {
    const PolicyFacts& facts = of(facts_, policy);
    return facts.drivable() && facts.outcome().contact ? ", " + harm_of(policy) : "";
  }
  [[nodiscard]] std::string harm_of(PolicyId policy) const {
    return harm_text(of(facts_, policy).outcome().harm);
  }

  /// The reply with these pieces.
  [[nodiscard]] std::string composed(const Arguments& all,
                                     const std::bitset<num_pieces>& told) const {
    const auto with = [&](Piece piece) {
      const auto place = static_cast<std::size_t>(piece);
      return told.test(place) ? all.pieces.at(place) : "";
    };
    const std::string ends = with(Piece::ends);
    std::vector<std::string> statements;
    if (!all.who.empty()) {
      statements.push_back(with(Piece::address) + all.who + with(Piece::beside) +
                           with(Piece::how_sure) + with(Piece::unprotected) + all.end +
                           (all.end.empty() ? "" : with(Piece::harm)));
    }
    statements.push_back(ends.empty() ? "" : ends + with(Piece::harm));
    statements.push_back(with(Piece::cue));
    statements.push_back(with(Piece::reason));
    statements.push_back(all.conclusion + with(Piece::margin));
    std::erase(statements, "");
    std::string text = "Scenario Analysis\n";
    for (std::size_t i = 0; i < statements.size(); ++i) {
      text += fmt::format("{}. {}.\n", i + 1, statements[i]);
    }
    return text + fmt::format("Response to user: {}", manoeuvre::index(choice_));
  }

  Arguments arguments() {
    Arguments all;
    const PolicyFacts& nothing = of(facts_, PolicyId::no_intervention);
    const bool is_safe = nothing.drivable() && !may_touch(nothing);
    const std::optional<std::size_t> who = most_dangerous();
    if (who) {
      add_threat(*who, is_safe, all);
    }
    // What comes of doing nothing or of braking.
    const bool braking = choice_ != PolicyId::aeb && !is_safe && (perhaps() || !nothing.drivable());
    if (braking || (choice_ != PolicyId::no_intervention && nothing.drivable())) {
      const PolicyId tried = braking ? PolicyId::aeb : PolicyId::no_intervention;
      const PolicyFacts& facts = of(facts_, tried);
      const std::optional<collision::Contact> contact =
          facts.drivable() ? facts.outcome().contact : std::nullopt;
      const bool hits_who = contact && contact->actor && contact->actor == who;
      const std::string how = called(tried) + ' ' + (hits_who ? "hits it" : end_of(tried));
      const bool of_whom = hits_who || (who && facts.drivable() && !contact);
      (of_whom ? all.end : all[Piece::ends]) = of_whom ? ": " + how : how;
      all[Piece::harm] = with_harm(tried);
    }
    if (const world::Cue* const cue = next_cue()) {
      all[Piece::cue] = warning(*cue);
    } else if (const std::vector<std::string> more = reasons(); !more.empty()) {
      all[Piece::reason] =
          more.at(std::uniform_int_distribution<std::size_t>(0, more.size() - 1)(random_));
    }
    conclude(all);
    return all;
  }

  [[nodiscard]] bool is_told(std::size_t actor) const {
    const auto& actors = situation_.scene_at_trigger.actors;
    return !rest_of_line(prompt_, actor_name(actors[actor]) + ": ").empty();
  }

  /// Who is hit if nothing is done; else, of those whom the prompt tells of, that of the highest
  /// risk.
  [[nodiscard]] std::optional<std::size_t> most_dangerous() const {
    const PolicyFacts& nothing = of(facts_, PolicyId::no_intervention);
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

  void add_threat(std::size_t who, bool is_safe, Arguments& all) {
    const Actor& actor = situation_.scene_at_trigger.actors[who];
    const std::string name = actor_name(actor);
    const ActorLine told = read_actor_line(rest_of_line(prompt_, name + ": "));
    all.who = name + ", " + told.along;
    all[Piece::beside] = beside(who) ? ", " + told.across : "";
    if (is_safe) {
      all[Piece::address] = one_of("Nearest to danger is ", "Most to be watched is ");
      all[Piece::how_sure] = ", " + told.risk;
      return;
    }
    all[Piece::address] = one_of("Most dangerous is ", "The danger is ");
    const bool in_time = !told.conflict.empty() && (told.intention.empty() || perhaps());
    all[Piece::how_sure] = ", " + (in_time                  ? told.conflict
                                   : told.intention.empty() ? told.risk
                                                            : told.intention);
    all[Piece::unprotected] = collision::unprotected(actor.kind) ? ", unprotected" : "";
  }

  /// Whether where somebody is sideways says more than that he is ahead.
  [[nodiscard]] bool beside(std::size_t who) const {
    constexpr double half_lane = 1.75;  // [m]
    const world::Scene& scene = situation_.scene_at_trigger;
    return std::abs((inverse(scene.ego.X_WB) * scene.actors[who].X_WA.p).y) > half_lane;
  }

  /// What may be said besides, each by itself.
  std::vector<std::string> reasons() {
    std::vector<std::string> all;
    for (const int side : {1, -1}) {
      add_side(side, all);
    }
    if (nearest_) {
      all.push_back(one_of("In the most alike case ", "In the nearest case ") +
                    called(nearest_->best) + " was best in hindsight" +
                    (nearest_->plan.policy != nearest_->best &&
                             nearest_->harm > nearest_->best_harm + memory::as_good
                         ? ", though " + called(nearest_->plan.policy) + " was carried out"
                         : ""));
    }
    return all;
  }

  void add_side(int side, std::vector<std::string>& all) {
    const world::Road& road = situation_.scene_at_trigger.road;
    const std::string word = side > 0 ? "left" : "right";
    const std::optional<PolicyId> best = best_to(side);
    if (!best && manoeuvre::side(choice_) != side) {
      all.push_back(one_of("The way to the " + word, "All to the " + word) +
                    (can_go(side) ? " is blocked" : " is not possible"));
    } else if (best && manoeuvre::side(choice_) != side) {
      all.push_back(one_of("To the " + word + " ", "On the " + word + " ") + called(*best) + ' ' +
                    end_of(*best) + with_harm(*best));
    }
    if ((side > 0 ? road.oncoming_left : road.oncoming_right) && best) {
      all.push_back("To the " + word + " is an oncoming lane");
    }
    const double d = to_lane(road, situation_.scene_at_trigger.ego.X_WB).d;
    const double way = side > 0 ? road.left_edge - d : d - road.right_edge;
    const world::Beyond beyond = side > 0 ? road.left_beyond : road.right_beyond;
    if (way < near_edge && beyond != world::Beyond::unmarked) {
      all.push_back(fmt::format("Beyond the {} edge, {:.1f} m away, {} {}", word,
                                std::max(way, 0.0), beyond == world::Beyond::trees ? "are" : "is a",
                                beyond_text(beyond)));
    }
  }

  /// The nearest cue that is ahead; nullptr: none is.
  [[nodiscard]] const world::Cue* next_cue() const {
    const world::Cue* next = nullptr;
    for (const world::Cue& cue : situation_.scene_at_trigger.cues) {
      if (place_of(cue).x > 0.0 && (next == nullptr || place_of(cue).x < place_of(*next).x)) {
        next = &cue;
      }
    }
    return next;
  }
  /// Seen from the ego [m].
  [[nodiscard]] Vec2 place_of(const world::Cue& cue) const {
    return inverse(situation_.scene_at_trigger.ego.X_WB) * cue.p_W;
  }
  /// +1: to the left of our lane, -1: to the right; 0: on it, or it is the road itself.
  [[nodiscard]] int side_of(const world::Cue& cue) const {
    constexpr double half_lane = 1.0;  // [m], and a person's half
    const double y = place_of(cue).y;
    return cue.kind == world::CueKind::wet_leaves || std::abs(y) < half_lane ? 0 : y > 0.0 ? 1 : -1;
  }

  /// "The row of parked vans 12.0 m ahead, 3.5 m right may hide somebody".
  std::string warning(const world::Cue& cue) {
    return fmt::format("The {} {} {}", cue_text(cue.kind),
                       cue_place(cue, situation_.scene_at_trigger),
                       cue.kind == world::CueKind::wet_leaves
                           ? one_of("may leave less grip", "may be slippery")
                           : one_of("may hide somebody", "may mean somebody who is not seen"));
  }

  [[nodiscard]] bool can_go(int side) const {
    return std::any_of(facts_.begin(), facts_.end(), [side](const PolicyFacts& facts) {
      return manoeuvre::side(facts.plan.policy) == side && facts.drivable();
    });
  }

  /// The best policy to a side that touches nobody for certain; nullopt: all are blocked.
  [[nodiscard]] std::optional<PolicyId> best_to(int side) const {
    return best_where(facts_, [side](const PolicyFacts& facts) {
      return manoeuvre::side(facts.plan.policy) == side && !facts.outcome().contact;
    });
  }

  // Why this choice and not the next best. It begins with its name, so that what is chosen is
  // settled before it is reasoned why.
  void conclude(Arguments& all) const {
    const std::string chosen = "So " + called(choice_) + ": ";
    const std::optional<PolicyId> other = next_best();
    if (!other) {
      all.conclusion = chosen + "it alone is possible";
    } else if (admissible(facts_).count() == 1) {
      all.conclusion = chosen + "least harm, next " + called(*other);
      all[Piece::margin] = ", " + harm_of(*other);
    } else {
      all.conclusion = chosen + "as good as " + called(*other) +
                       advantage(of(facts_, choice_), of(facts_, *other));
    }
  }

  /// The best by forecast of the others.
  [[nodiscard]] std::optional<PolicyId> next_best() const {
    return best_where(facts_,
                      [this](const PolicyFacts& facts) { return facts.plan.policy != choice_; });
  }

  /// What speaks for the one of two that harm about as little; empty: nothing that is told.
  [[nodiscard]] std::string advantage(const PolicyFacts& mine, const PolicyFacts& theirs) const {
    const PolicyId other = theirs.plan.policy;
    if (collision::milder(choice_, other)) {
      return ", and milder";
    }
    if (choice_ == PolicyId::aeb && other == PolicyId::no_intervention) {
      return ", and less speed harms less if a forecast errs";
    }
    const world::Cue* const cue = next_cue();
    if (cue != nullptr && side_of(*cue) != 0 && manoeuvre::side(other) == side_of(*cue) &&
        manoeuvre::side(choice_) != side_of(*cue)) {
      return fmt::format(", and keeps away from the {}", cue_text(cue->kind));
    }
    if (mine.contact_probability() + unlikely < theirs.contact_probability()) {
      return ", and touches somebody less often";
    }
    const world::Road& road = situation_.scene_at_trigger.road;
    if (leads_into_oncoming(road, other) && !leads_into_oncoming(road, choice_)) {
      return ", and stays out of the oncoming lane";
    }
    if (nearest_ && nearest_->best == choice_) {
      return ", and this was best in the most alike case";
    }
    return "";
  }

  const preview::Situation& situation_;
  const AllFacts& facts_;
  std::string_view prompt_;
  const std::optional<memory::Case>& nearest_;
  PolicyId choice_;
  std::mt19937_64& random_;
};

}  // namespace

std::string expert_reply(const preview::Situation& situation, std::string_view scene_part,
                         const std::optional<memory::Case>& nearest, PolicyId choice,
                         int most_tokens, std::mt19937_64& random) {
  expects(admissible(situation.facts).test(manoeuvre::index(choice)), "an admissible choice");
  return Speaker(situation, scene_part, nearest, choice, random).reply(most_tokens);
}

}  // namespace saca::language_model
