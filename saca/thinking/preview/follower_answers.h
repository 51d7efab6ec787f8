#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/drivers/driver.h"
#include "saca/onboard/reflex/followers.h"

namespace saca::preview {

/// What the followers of a scene do in answer to one motion of the ego after the other: to the last
/// bit as let_react has it, in less time where motions agree for a while. Motions of one way that
/// differ only in where the ego is struck do: up to there the followers do the same, and are looked
/// for only from there on.
class FollowerAnswers {
 public:
  /// Refers to the scene.
  /// @param until  of the tracks [s]
  /// @param step   likewise [s], > 0
  FollowerAnswers(const world::Scene& scene, double until, double step);

  /// Whose answers they are: the nearest to the ego first.
  [[nodiscard]] const reflex::Followers& followers() const { return followers_; }

  /// The tracks of the nearest `num` followers, in the order of `followers`; valid until the next
  /// call.
  /// @param X_WB  the ego from the scene's time on
  /// @param num   at most the number of followers
  [[nodiscard]] std::span<const world::Track> to(const world::Track& X_WB, std::size_t num);

  /// Keeps the answers of all followers to this motion, for those that begin as it does.
  void remember(const world::Track& X_WB);

 private:
  /// An answer, with what every follower had ahead of it in every step.
  struct Answer {
    world::Track X_WB;
    std::size_t num = 0;  ///< of followers who are in it, the nearest
    std::vector<world::Track> tracks;
    std::vector<std::vector<drivers::Ahead>> seen;
  };

  [[nodiscard]] std::size_t same_steps(const world::Track& a, const world::Track& b) const;
  void go_on(Answer& answer, std::size_t follower, std::size_t step) const;

  const world::Scene& scene_;
  reflex::Followers followers_;
  double step_;
  std::size_t num_steps_;
  std::vector<drivers::LaneDriver> drivers_;  ///< of each follower, at the scene's time
  std::vector<Answer> remembered_;
  Answer last_;
};

}  // namespace saca::preview
