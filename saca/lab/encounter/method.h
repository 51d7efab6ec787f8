#pragma once

#include <limits>
#include <optional>
#include <string>

#include "saca/base/world/scene.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/encounter/thinking_figures.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/intent/observer.h"

namespace saca::encounter {

/// What a method is shown at one instant.
struct View {
  const world::Scene& scene;          ///< as perceived
  const intent::Beliefs& beliefs;     ///< one per actor of it
  const reflex::ActorSet& confirmed;  ///< who of it may set off SACA's trigger; published rules
                                      ///< of others know no such thing
  bool driven = false;                ///< somebody threatens within T2, or did: the wheel is taken
  bool finished = false;              ///< what is carried out has reached its safe end
  const ClosedLoop& truth;            ///< for yardsticks that know what nobody can; no method on a
                                      ///< road may look
};

/// What a method does from an instant on.
struct Action {
  manoeuvre::Plan plan;
  double deceleration = std::numeric_limits<double>::infinity();  ///< largest that the brakes are
                                                                  ///< asked for [m/s^2], > 0
  std::string source;  ///< where the decision came from, in a word; may be empty
  std::string reason;  ///< why, in a sentence; may be empty
};

/// Whatever decides, in one encounter: SACA, a baseline, a yardstick. All are run in the same
/// closed loop.
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Called at every instant, 10 ms apart, from the first on.
  /// @return  a plan to begin now, in place of what was carried out; the same plan with another
  ///          deceleration goes on; nullopt: goes on as it is
  [[nodiscard]] virtual std::optional<Action> step(const View& view) = 0;

  /// Who carries out what this method begins, and drives from then on (ClosedLoop::advance);
  /// nullptr: the closed loop does.
  [[nodiscard]] virtual Avoider* avoider() { return nullptr; }

  /// What was thought until now; nullopt: this method does not think ahead.
  [[nodiscard]] virtual std::optional<ThinkingFigures> thinking() const { return std::nullopt; }
};

}  // namespace saca::encounter
