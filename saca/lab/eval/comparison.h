#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/encounter/method.h"
#include "saca/lab/eval/yardstick.h"

namespace saca::eval {

/// What one method did in one encounter, and what came of it.
struct MethodRun {
  std::optional<double> acted_at;       ///< when it first intervened [s]; nullopt: never
  std::optional<manoeuvre::Plan> plan;  ///< with what, as it was carried out; no intervention where
                                        ///< it decided on that and never on more; nullopt: it
                                        ///< decided on nothing
  std::string source;  ///< where its first decision came from, doing nothing among them, in a word
  std::string reason;  ///< why it decided so, in a sentence
  int switches = 0;    ///< how often it began another plan later
  double harm = 0.0;   ///< of all contacts
  double collision_loss = 0.0;     ///< the paper's, of the first contact
  std::optional<std::string> met;  ///< with whom or what the first contact was
  double impact_speed = 0.0;       ///< relative, of that contact [m/s]
  double ego_speed = 0.0;          ///< of the ego at that contact [m/s]
  double peak_deceleration = 0.0;  ///< largest of the ego along its heading before that
                                   ///< contact [m/s^2], >= 0
  double clearance = 0.0;          ///< smallest distance to anybody [m]; 0 with contact
  std::optional<encounter::ThinkingFigures>
      thinking;       ///< what was thought in it; nullopt: the method does not think ahead
  std::string fault;  ///< what it threw; empty: nothing. It then did no more

  [[nodiscard]] bool intervened() const;
};

/// One plan, begun at T1 and tried with full knowledge.
struct TriedPlan {
  manoeuvre::Plan plan;
  std::optional<double> harm;  ///< nullopt: it cannot be driven
  bool contact = false;
};

/// What several methods did in one encounter with the same draws.
struct Comparison {
  std::optional<double>
      trigger;                 ///< T1: when the rule of the reflex plane fires if nobody acts [s]
  std::optional<double> woke;  ///< T2: when somebody first threatens within it [s]
  std::optional<std::string> threat;    ///< who sets off T1
  std::vector<TriedPlan> tried;         ///< from T1 on, in the order of forecast::all_plans; empty
                                        ///< where T1 never comes
  std::optional<manoeuvre::Plan> best;  ///< of these
  double best_harm = 0.0;               ///< of the best; where T1 never comes, of doing nothing
  double published_best_harm = 0.0;     ///< likewise of the paper's eight policies, whose braking
                                        ///< has one strength
  std::vector<MethodRun> runs;          ///< one per method
};

/// Runs methods in closed loop, in one encounter, with the same world, draws and perception.
///
/// Methods that have done the same so far share one simulation; where they part, it is copied. So a
/// method's row is what it alone would have met, at a fraction of the work; and what all are held
/// against (T1, what was tried then) does not depend on which there are.
/// @param methods    made for this encounter; each is stepped at every instant of it
/// @param hindsight  of this encounter
/// @return  Error::Code::out_of_range when the encounter cannot be played: a scene of it breaks a
///          rule while some method has not acted
[[nodiscard]] Result<Comparison> compare(
    const encounter::Stage& stage, const std::vector<std::unique_ptr<encounter::Method>>& methods,
    Hindsight& hindsight);

}  // namespace saca::eval
