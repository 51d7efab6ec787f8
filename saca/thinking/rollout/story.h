#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/core/static_vector.h"
#include "saca/base/world/scene.h"
#include "saca/onboard/collision/impact.h"
#include "saca/onboard/forecast/prepared_motion.h"
#include "saca/thinking/rollout/slide.h"

namespace saca::rollout {

/// What else than contacts a story tells, and how finely.
struct StoryDetail {
  double clearance = collision::far_away;  ///< that is told, at most [m]
  SlideSteps slides;
  double look_again = 0.01;  ///< between two looks at bodies that stay together [s]
};
/// For forecasts.
constexpr StoryDetail only_contacts{.clearance = 0.0, .slides = coarse_slide, .look_again = 0.05};

/// What comes next.
struct Event {
  double time = 0.0;                    ///< [s]
  std::optional<std::size_t> actor;     ///< index into scene.actors; nullopt: the edge of the road
  std::optional<collision::Side> edge;  ///< of the road, when it is no actor
  bool presses_on = false;              ///< they have not parted since they last met
};

/// What comes of a motion of the ego, told event by event: who meets whom next, and how all move
/// then (see collision_sequence). Refers to what it is made of.
class Story {
 public:
  /// @param detail  what else than contacts is told, and how finely
  Story(forecast::PreparedMotion& motion, const collision::HarmModel& harm, double grip,
        const StoryDetail& detail = {});
  Story(const Story&) = delete;  // parts of it refer to one another
  Story& operator=(const Story&) = delete;

  /// The ego's motion so far, and as it will be if nothing more happens.
  [[nodiscard]] manoeuvre::EgoMotion ego() const;
  /// The same without velocities.
  [[nodiscard]] const world::Track& ego_track();

  /// Now the others move so, as long as they are not struck.
  /// @param all  one per actor; what they refer to lasts until the next call
  void expect(std::span<const collision::Mover* const> all);

  /// The next thing that happens, if any.
  [[nodiscard]] std::optional<Event> next();

  /// It happens.
  /// @return  whether anybody now moves otherwise
  bool happen(const Event& event);

  [[nodiscard]] collision::Outcome outcome() const;

  [[nodiscard]] std::vector<world::Track> others() const;
  /// Of each actor: does it no longer move as was expected?
  [[nodiscard]] StaticVector<bool, world::max_actors> struck() const;

 private:
  /// What has passed between the ego and somebody or something.
  struct Dealings {
    std::optional<double> last_impact;  ///< [s]
    bool over = false;                  ///< nothing more can come of it
  };
  struct Other {
    Dealings dealings;
    const collision::Mover* expected = nullptr;
    std::vector<manoeuvre::EgoMotion> slides;
    std::optional<collision::Mover> slides_on;  ///< the last of them; none: not needed yet

    [[nodiscard]] const world::Track& track() const {
      return slides.empty() ? expected->track() : slides.back().track;
    }
  };

  [[nodiscard]] const manoeuvre::EgoMotion& now() const {
    return ego_slides_.empty() ? motion_.intended() : ego_slides_.back();
  }
  [[nodiscard]] bool was_struck() const { return !ego_slides_.empty(); }
  [[nodiscard]] const world::Track& track(std::size_t i) const { return others_[i].track(); }
  /// A slide ends at rest, whatever its last step was like.
  [[nodiscard]] bool other_moves_at_end(std::size_t i) const;
  [[nodiscard]] collision::Instant other_at(std::size_t i, double time) const {
    const Other& other = others_[i];
    return other.slides.empty() ? collision::instant_at(other.track(), time)
                                : collision::instant_at(other.slides.back(), time);
  }
  /// Made once for each track: that looks at all of its poses.
  [[nodiscard]] const collision::Mover& ego_mover();
  [[nodiscard]] const collision::Mover& mover(std::size_t i);
  [[nodiscard]] Dealings& dealings(collision::Side side) {
    return edges_[static_cast<std::size_t>(side)];
  }

  [[nodiscard]] double last_time() const;
  [[nodiscard]] std::optional<Event> next_at(collision::Side side);
  [[nodiscard]] std::optional<Event> next_with(std::size_t i, double until, bool first);
  void pass(double distance, const collision::Nearest& whom) {
    if (distance < clearance_) {
      clearance_ = distance;
      nearest_ = whom;
    }
  }
  void note(const collision::Impact& impact, const Event& event);
  [[nodiscard]] manoeuvre::EgoMotion slide_of(const world::Footprint& footprint, double mass,
                                              const collision::Instant& after, double time) const;

  forecast::PreparedMotion& motion_;
  const world::Scene& scene_;
  const collision::HarmModel& harm_;
  double grip_;
  double since_;  ///< when the last event happened [s]
  double clearance_;
  std::optional<collision::Nearest> nearest_;
  SlideSteps steps_;
  double look_again_;
  std::vector<Other> others_;      ///< one per actor
  std::array<Dealings, 2> edges_;  ///< by Side
  std::vector<manoeuvre::EgoMotion> ego_slides_;
  std::optional<collision::Mover> ego_slides_on_;  ///< the last of them; none: not needed yet
  world::Track concatenated_;  ///< the ego's way with the first `num_concatenated_` slides
  std::size_t num_concatenated_ = 0;
  std::vector<collision::Impact> impacts_;  ///< in order of time
  std::optional<std::size_t> first_;        ///< of them: the first that struck the ego
};

}  // namespace saca::rollout
