#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/supervisor.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/intent/observer.h"

namespace saca::encounter {

/// A verdict that the reflex plane had in hand.
struct NotedVerdict {
  double received = 0.0;  ///< when it was handed over, or made by the reflex plane itself [s]
  reflex::Verdict verdict;
  bool by_atlas = false;                     ///< the reflex plane's own
  std::optional<manoeuvre::Plan> under_way;  ///< in the scene that was judged; nullopt: nothing was
};

/// The scene of a verdict by which a plan was begun, and what was believed of it: what that verdict
/// was made from.
struct JudgedScene {
  double begun = 0.0;  ///< when the plan was begun [s]
  world::Scene scene;  ///< as perceived
  intent::Beliefs beliefs;
  bool by_atlas = false;  ///< the verdict was the reflex plane's own
};

/// Takes note of the verdicts of one encounter, as the reflex plane gets them. For the record: it
/// allocates, so it belongs to whoever drives the encounter, never to the reflex plane.
class VerdictLog {
 public:
  /// Of more plans begun, the judged scenes are not kept: T1 and seven switches.
  static constexpr std::size_t most_judged = 8;

  /// One instant of the reflex plane, in which it may have got a verdict.
  /// @param beliefs  one per actor of the scene
  /// @param got      handed over in this instant; nullopt: none was
  void note(const world::Scene& scene, const intent::Beliefs& beliefs,
            const std::optional<reflex::Verdict>& got);

  /// The plan of the trigger was begun in the instant that was noted last.
  void note(const reflex::Decision& decision);

  /// Another plan was begun in the instant that was noted last, by the newest verdict got.
  void note(const reflex::Switch& change);

  [[nodiscard]] const std::vector<NotedVerdict>& verdicts() const { return verdicts_; }
  /// Of T1, where a verdict was decided by, then of the switches.
  [[nodiscard]] const std::vector<JudgedScene>& judged() const { return judged_; }

 private:
  struct Look {
    world::Scene scene;
    intent::Beliefs beliefs;
  };
  struct Begun {
    double time = 0.0;  ///< [s]
    manoeuvre::Plan plan;
  };

  void add(const reflex::Verdict& verdict, bool by_atlas);
  void keep_judged(double verdict_time, bool by_atlas);

  double now_ = 0.0;         ///< of the instant that was noted last [s]
  std::deque<Look> recent_;  ///< by time: those whose verdicts can still be decided by
  std::vector<Begun> begun_;
  std::vector<NotedVerdict> verdicts_;
  std::vector<JudgedScene> judged_;
};

}  // namespace saca::encounter
