#pragma once

#include <array>

#include "saca/base/world/scene.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/collision/impact.h"
#include "saca/onboard/forecast/broad_phase.h"

namespace saca::forecast {

/// Mean and variance of a place along one direction.
struct Moments {
  double mean = 0.0;      ///< [m]
  double variance = 0.0;  ///< [m^2]
};
/// Of what the grip's standard deviation does to it, as two halves of normal distributions: less
/// grip adds `less` per standard deviation, more adds `more`.
[[nodiscard]] Moments of_halves(double less, double more) noexcept;

/// The ego on a way out of the atlas, in the world. All of it noexcept, without allocation.
class AtlasEgo {
 public:
  /// Refers to path and scene.
  AtlasEgo(const atlas::AtlasPath& path, const world::Scene& scene) noexcept;

  /// @param time  since the scene's [s]
  [[nodiscard]] collision::Instant at(double time) const noexcept;
  /// Offset and heading in the lane.
  [[nodiscard]] world::LanePose in_lane(double time) const noexcept;
  /// Displacement of the ego by the grip's standard deviation, in W [m].
  struct Sensitivities {
    Vec2 less_W;  ///< with so much less grip
    Vec2 more_W;  ///< with so much more
  };
  [[nodiscard]] Sensitivities with_sensitivity(double time) const noexcept;

  /// How much of the atlas' sensitivity to friction the grip's standard deviation gives, both >= 0.
  struct GripShares {
    double less = 0.0;
    double more = 0.0;
  };
  [[nodiscard]] const GripShares& grip_shares() const noexcept { return grip_shares_; }

  [[nodiscard]] const atlas::AtlasPath& path() const noexcept { return *path_; }
  [[nodiscard]] const world::Scene& scene() const noexcept { return *scene_; }
  /// How long it is looked at [s]: two seconds beyond a recovered lane; at rest, without end.
  [[nodiscard]] double last_sample() const noexcept { return last_sample_; }
  /// From where the ego is at the scene's time.
  [[nodiscard]] const PoseSamples& samples() const noexcept { return samples_; }
  /// The most that the grip's standard deviation moves it, at any time, on any side [m].
  [[nodiscard]] double most_moved_by_grip() const noexcept { return most_moved_by_grip_; }
  /// Of the heading in the lane, at the samples of the path.
  struct SampleDirections {
    alignas(32) std::array<float, atlas::atlas_samples> cosine;
    alignas(32) std::array<float, atlas::atlas_samples> sine;
  };
  [[nodiscard]] const SampleDirections& directions() const noexcept { return directions_; }
  /// `Sensitivities` at the samples, where the grip has a standard deviation.
  struct SensitivityAtSamples {
    alignas(32) SampleRow less_x;
    alignas(32) SampleRow less_y;
    alignas(32) SampleRow more_x;
    alignas(32) SampleRow more_y;
  };
  [[nodiscard]] const SensitivityAtSamples& sensitivity_at_samples() const noexcept {
    return sensitivity_at_samples_;
  }

 private:
  /// Of the path, at the samples' times: along and across the lane, direction against it.
  struct PathSamples {
    SampleRow x;
    SampleRow y;
    SampleRow cosine;
    SampleRow sine;
  };

  void fill_directions() noexcept;
  [[nodiscard]] PathSamples path_samples() const noexcept;
  void fill_samples() noexcept;
  void lay_along_arc(SampleRow& x, SampleRow& y) noexcept;
  void fill_sensitivities() noexcept;
  [[nodiscard]] atlas::AtlasInstant on_path(double time) const noexcept;
  [[nodiscard]] Vec2 lane_direction(double s) const noexcept;

  const atlas::AtlasPath* path_;
  const world::Scene* scene_;
  world::LanePose start_;
  Vec2 along_;                  // direction of the lane at X_WL, in W
  atlas::AtlasInstant at_end_;  // of the path
  double last_sample_ = 0.0;
  GripShares grip_shares_;
  double most_moved_by_grip_ = 0.0;
  PoseSamples samples_;
  SensitivityAtSamples sensitivity_at_samples_{};
  SampleRow
      lane_x_;  // direction of the lane at the samples, where the grip has a standard deviation
  SampleRow lane_y_;
  SampleDirections directions_;
};

}  // namespace saca::forecast
