#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "saca/base/world/scene.h"
#include "saca/base/world/track.h"
#include "saca/onboard/collision/gap.h"
#include "saca/onboard/forecast/atlas_ego.h"
#include "saca/onboard/forecast/broad_phase.h"

namespace saca::forecast {

/// Beyond so many standard deviations nothing happens.
constexpr double sure_sd = 4.0;

/// Standard deviations are no smaller [m].
constexpr double least_sd = 1e-3;

/// When two bodies are compared, and which groups of spans lie in it that matter.
struct Window {
  double from = 0.0;      // [s]
  double to = 0.0;        // [s]
  std::size_t first = 0;  // groups of spans
  std::size_t last = 0;
  bool any = false;  // such groups

  [[nodiscard]] std::size_t begin() const noexcept { return first * spans_per_group; }
  [[nodiscard]] std::size_t end() const noexcept { return (last + 1) * spans_per_group; }
  [[nodiscard]] bool holds(std::size_t span) const noexcept {
    return sample_time(span) <= to && sample_time(span + 1) >= from;
  }
};

/// Looks for what is least between the neighbours of one sample; `keep` says whether it is less
/// now.
/// @param more  samples after the first
template <class Keep>
void narrow(const Window& window, std::size_t sample, int more, const Keep& keep) noexcept {
  constexpr double shortest = 0.01;  // [s]
  const auto inside = [&](std::size_t k) {
    return std::clamp(sample_time(k), window.from, window.to);
  };
  double low = inside(sample > 0 ? sample - 1 : 0);
  double high = inside(std::min(sample + 1, num_spans));
  double middle = inside(sample);
  keep(middle);
  for (int i = 0; i < more && high - low > shortest; ++i) {
    const bool first = middle - low > high - middle;
    const double time = first ? 0.5 * (low + middle) : 0.5 * (middle + high);
    if (keep(time)) {
      (first ? high : low) = middle;
      middle = time;
    } else {
      (first ? low : high) = time;
    }
  }
}

/// The narrow phase of collision detection: the ego on a way out of the atlas and an actor on its
/// track, compared exactly at any one time.
class NarrowPhase {
 public:
  /// Refers to all of them.
  /// @param samples  of the track, from where the ego is at the scene's time
  /// @param spread  about the track; nullptr, or nothing said: as perceived, the same on each side,
  ///                and what the velocity's adds grows with time
  NarrowPhase(const AtlasEgo& ego, std::size_t actor, const world::Track& track,
              const PoseSamples& samples, const world::SpreadOverTime* spread = nullptr) noexcept;

  struct PairState {
    double time = 0.0;
    collision::Body mine;
    collision::Body other;
    collision::Gap gap;
    double size = 0.0;     ///< of the gap; exact where it decides on contact [m]
    double closing = 0.0;  ///< along the gap, turning included [m/s]
  };
  /// @param time  since the scene's [s]
  [[nodiscard]] PairState state_at(double time) const noexcept;
  /// Positive while they are apart: of boxes never more than the distance, of others exact [m].
  [[nodiscard]] double gap_at(double time) const noexcept;
  /// Exact; 0 while they touch [m].
  [[nodiscard]] double distance_at(double time) const noexcept;
  /// How many standard deviations are between them along a gap's direction.
  struct Score {
    double size = 0.0;
    Vec2 n;  ///< of the gap
  };
  struct Scores {
    double most = 0.0;             ///< of all directions that are looked at
    std::array<Score, 4> of_axis;  ///< as gaps_along_axes
  };
  /// They touch when they do along every direction, so that no score makes it likelier than the
  /// largest allows.
  [[nodiscard]] Scores scores(const PairState& now) const noexcept;
  /// Of the actor's place [m].
  /// @param time  since the scene's [s]
  [[nodiscard]] world::Spread actor_spread(double time) const noexcept;
  /// What is not known of both places at one time.
  struct Doubt {
    world::Spread spread;          ///< of the actor
    Vec2 along;                    ///< the way that it points
    AtlasEgo::Sensitivities grip;  ///< of the ego

    /// By how much they are nearer along n, from the ego to the actor, than at the mean; no
    /// variance is less than least_sd^2.
    [[nodiscard]] Moments nearer(Vec2 n) const noexcept;
    /// Where the actor is displaced to in the mean of all errors that bring both nearer by 1 m
    /// along n, as if the ego were where its mean is: the regression of places on that distance.
    [[nodiscard]] Vec2 displacement_per_metre(Vec2 n) const noexcept;
  };
  [[nodiscard]] Doubt doubt(const PairState& now) const noexcept;
  /// At most so much do both places spread until then [m].
  [[nodiscard]] double sd_until(double time) const noexcept;
  [[nodiscard]] bool spreads() const noexcept { return spreads_; }

  [[nodiscard]] const AtlasEgo& ego() const noexcept { return *ego_; }
  [[nodiscard]] const world::Actor& actor() const noexcept { return *actor_; }
  [[nodiscard]] const PoseSamples& samples() const noexcept { return *samples_; }

 private:
  // Only of boxes do a few directions tell for sure.
  [[nodiscard]] bool either_is_round() const noexcept;
  [[nodiscard]] double exact(double time, double size) const noexcept;

  const AtlasEgo* ego_;
  const world::Actor* actor_;
  const world::Track* track_;
  const PoseSamples* samples_;
  const world::SpreadOverTime* spread_;  // nullptr: as perceived
  double start_;
  double reach_;  // of both bodies together from their origins [m]
  bool spreads_;
};

}  // namespace saca::forecast
