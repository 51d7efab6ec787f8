#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// A reply has at most so many numbered statements, its conclusion among them.
constexpr int most_statements = 4;

/// What a reply says of a road user, piece by piece, from the prompt's line about it. A piece is
/// empty where that says nothing of it.
struct RoadUserPieces {
  std::string who;          ///< "truck1, 16 m ahead"
  std::string beside;       ///< ", 6.4 m left"; empty where that says no more than that it is ahead
  std::string risk;         ///< ", risk 0.94"
  std::string intention;    ///< ", maintain 0.94"
  std::string conflict;     ///< ", TTC 0.9 s"
  std::string unprotected;  ///< ", unprotected"
};

/// Something that may be said besides, each by itself.
struct Remark {
  std::vector<std::string> wordings;  ///< at least one
  /// +1 or -1: about what lies to the left or right, for a choice that does not go there; 0: for
  /// any.
  int side = 0;
  bool rules_out = false;  ///< nothing to that side is open: never beside a choice of that side
};

/// The pieces that true replies are made of, in the words that models are taught: none of them, and
/// no statement that the functions below put together, is refuted by `truth_of`. What that cannot
/// check (what a cue may mean, that a way keeps away from it, that less speed harms less if a
/// forecast errs) is so by construction.
class Statements {
 public:
  /// The arguments must outlive this object.
  /// @param scene_part  of this situation and case
  /// @param nearest     as for the scene part
  Statements(const preview::Situation& situation, std::string_view scene_part,
             const std::optional<memory::Case>& nearest)
      : situation_(situation), prompt_(scene_part), nearest_(nearest) {}

  /// A policy's forecast.
  [[nodiscard]] const preview::PolicyFacts& facts(manoeuvre::PolicyId policy) const {
    return situation_.facts[manoeuvre::index(policy)];
  }
  /// Nothing need be done: nobody is likely to be touched then.
  [[nodiscard]] bool is_safe() const;

  /// Whether the prompt has a line about a road user.
  [[nodiscard]] bool is_told(std::size_t actor) const;
  /// Who is hit if nothing is done; else, of those whom the prompt tells of, that of the highest
  /// risk.
  [[nodiscard]] std::optional<std::size_t> most_dangerous() const;
  /// How he may be introduced: "The danger is ".
  [[nodiscard]] std::vector<std::string> addresses() const;
  /// @param actor  one whom the prompt has a line about
  [[nodiscard]] RoadUserPieces pieces_of(std::size_t actor) const;

  /// "AEB is clear by 0.6 m", "AEB hits car1": what the prompt has of it, in short, or "T-D-L is
  /// not possible"; empty: it has nothing.
  [[nodiscard]] std::string end_of(manoeuvre::PolicyId policy) const;
  /// Likewise, behind what is said of a road user: "AEB hits it"; empty: it hits somebody else.
  [[nodiscard]] std::string end_beside(manoeuvre::PolicyId policy, std::size_t actor) const;
  /// ", harm 0.013" of what is not clear; empty: it is.
  [[nodiscard]] std::string with_harm(manoeuvre::PolicyId policy) const;

  /// What the nearest cue that is ahead may mean, in several wordings; empty: there is none.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// What lies to either side, and how the most alike case ended.
  [[nodiscard]] std::vector<Remark> remarks() const;

  /// Whether only one policy is admissible.
  [[nodiscard]] bool is_alone() const;
  /// The best by forecast of the others; nullopt: no other can be driven.
  [[nodiscard]] std::optional<manoeuvre::PolicyId> next_best(manoeuvre::PolicyId choice) const;
  /// The last statement up to its comparison: "So AEB: as good as NI". It begins with the choice's
  /// name, so that what is chosen is settled before it is reasoned why.
  /// @param choice  admissible
  /// @param other   another one, likewise where several are, else the next best; nullopt: no other
  ///                can be driven
  [[nodiscard]] std::string conclusion(manoeuvre::PolicyId choice,
                                       const std::optional<manoeuvre::PolicyId>& other) const;
  /// What may follow it: ", harm 0.072" of the next best where the choice alone is admissible;
  /// else what speaks for the one of two, the weightiest first. Each may be left out.
  [[nodiscard]] std::vector<std::string> advantages(manoeuvre::PolicyId choice,
                                                    manoeuvre::PolicyId other) const;

 private:
  [[nodiscard]] bool has_hindsight() const;
  [[nodiscard]] Vec2 place_of(const world::Cue& cue) const;
  [[nodiscard]] int side_of(const world::Cue& cue) const;
  [[nodiscard]] const world::Cue* next_cue() const;
  [[nodiscard]] std::optional<manoeuvre::PolicyId> best_to(int side) const;
  void add_side(int side, std::vector<Remark>& all) const;

  const preview::Situation& situation_;
  std::string_view prompt_;
  const std::optional<memory::Case>& nearest_;
};

}  // namespace saca::language_model
