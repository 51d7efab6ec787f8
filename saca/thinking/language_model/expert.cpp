#include "saca/thinking/language_model/expert.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/statements.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;

/// What may be left out of a reply.
enum class Piece : std::uint8_t {
  cue,          ///< a statement
  beside,       ///< ", 6.4 m left"
  how_sure,     ///< ", maintain 0.94"
  unprotected,  ///< ", unprotected"
  ends,         ///< "AEB hits car2": how somebody else fares than who threatens
  harm,         ///< ", harm 0.59"
  margin,       ///< ", harm 0.072", of the next best
  reason,       ///< a statement
  address       ///< "The danger is "
};
constexpr std::size_t num_pieces = 9;

/// What a reply is put together from. Empty: does not apply.
struct Arguments {
  std::string who;         ///< "truck1, 16 m ahead"
  std::string end;         ///< ": NI hits it"
  std::string conclusion;  ///< a statement
  std::array<std::string, num_pieces> pieces;

  std::string& operator[](Piece piece) { return pieces.at(static_cast<std::size_t>(piece)); }
};

/// Draws arguments, and puts them together.
class Speaker {
 public:
  Speaker(const Statements& statements, PolicyId choice, std::mt19937_64& random)
      : statements_(statements), choice_(choice), random_(random) {}

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
  const std::string& one_of(const std::vector<std::string>& all) {
    return all.at(std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random_));
  }
  bool perhaps() { return std::uniform_int_distribution<int>(0, 1)(random_) == 1; }

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
    const bool is_safe = statements_.is_safe();
    const std::optional<std::size_t> who = statements_.most_dangerous();
    if (who) {
      add_threat(*who, is_safe, all);
    }
    // What comes of doing nothing or of braking.
    const bool can_do_nothing = statements_.facts(PolicyId::no_intervention).drivable();
    const bool braking = choice_ != PolicyId::aeb && !is_safe && (perhaps() || !can_do_nothing);
    if (braking || (choice_ != PolicyId::no_intervention && can_do_nothing)) {
      const PolicyId tried = braking ? PolicyId::aeb : PolicyId::no_intervention;
      const std::string beside = who ? statements_.end_beside(tried, *who) : "";
      (beside.empty() ? all[Piece::ends] : all.end) =
          beside.empty() ? statements_.end_of(tried) : ": " + beside;
      all[Piece::harm] = statements_.with_harm(tried);
    }
    if (const std::vector<std::string> warnings = statements_.warnings(); !warnings.empty()) {
      all[Piece::cue] = one_of(warnings);
    } else if (const std::vector<std::string> more = remarks(); !more.empty()) {
      all[Piece::reason] = one_of(more);
    }
    conclude(all);
    return all;
  }

  void add_threat(std::size_t who, bool is_safe, Arguments& all) {
    const RoadUserPieces pieces = statements_.pieces_of(who);
    all.who = pieces.who;
    all[Piece::beside] = pieces.beside;
    all[Piece::address] = one_of(statements_.addresses());
    if (is_safe) {
      all[Piece::how_sure] = pieces.risk;
      return;
    }
    const bool in_time = !pieces.conflict.empty() && (pieces.intention.empty() || perhaps());
    all[Piece::how_sure] = in_time                    ? pieces.conflict
                           : pieces.intention.empty() ? pieces.risk
                                                      : pieces.intention;
    all[Piece::unprotected] = pieces.unprotected;
  }

  /// What may be said besides, each worded in one way.
  std::vector<std::string> remarks() {
    std::vector<std::string> all;
    for (const Remark& remark : statements_.remarks()) {
      if (remark.side != 0 && remark.side == manoeuvre::side(choice_)) {
        continue;
      }
      all.push_back(remark.wordings.size() == 1 ? remark.wordings.front()
                                                : one_of(remark.wordings));
    }
    return all;
  }

  // Why this choice and not the next best.
  void conclude(Arguments& all) const {
    const std::optional<PolicyId> other = statements_.next_best(choice_);
    all.conclusion = statements_.conclusion(choice_, other);
    if (!other) {
      return;
    }
    const std::vector<std::string> advantages = statements_.advantages(choice_, *other);
    if (statements_.is_alone()) {
      all[Piece::margin] = advantages.front();
    } else if (!advantages.empty()) {
      all.conclusion += advantages.front();
    }
  }

  const Statements& statements_;
  PolicyId choice_;
  std::mt19937_64& random_;
};

}  // namespace

std::string expert_reply(const preview::Situation& situation, std::string_view scene_part,
                         const std::optional<memory::Case>& nearest, PolicyId choice,
                         int most_tokens, std::mt19937_64& random) {
  expects(admissible(situation.facts).test(manoeuvre::index(choice)), "an admissible choice");
  const Statements statements(situation, scene_part, nearest);
  return Speaker(statements, choice, random).reply(most_tokens);
}

}  // namespace saca::language_model
