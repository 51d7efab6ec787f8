#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "saca/base/core/simd_level.h"
#include "saca/base/world/footprint.h"
#include "saca/base/world/track.h"

namespace saca::forecast {

// Everybody at the same few instants, in floats that lie side by side: what cannot touch or come
// near between two of them is passed over: the broad phase of collision detection, before the
// narrow one (narrow_phase.h).

constexpr std::size_t num_spans = 40;  ///< of time: 16 of 0.2 s, 16 of 0.4 s, 8 of 1.6 s
constexpr std::size_t spans_per_group = 4;
constexpr std::size_t num_groups = num_spans / spans_per_group;
constexpr double samples_end = 22.4;  ///< of the last span [s]

/// One number for each sample, at the beginning of a span; the one behind the last span ends it.
/// The rest is room for whole packs.
using SampleRow = std::array<float, num_spans + 8>;

/// Samples, or the spans that begin at them, from `begin` on and before `end`.
struct SampleRange {
  std::size_t begin;
  std::size_t end;
};

/// When span `k` begins [s since the scene's time]; num_spans: when the last one ends.
[[nodiscard]] constexpr double sample_time(std::size_t k) noexcept {
  const auto at = static_cast<double>(k);
  return k <= 16 ? 0.2 * at : k <= 32 ? 0.4 * at - 3.2 : 1.6 * at - 41.6;
}
/// sample_time for all.
constexpr SampleRow sample_times = [] {
  SampleRow times{};
  for (std::size_t k = 0; k < times.size(); ++k) {
    times[k] = static_cast<float>(sample_time(k));
  }
  return times;
}();

/// The span that holds a time >= 0; num_spans after all of them.
[[nodiscard]] std::size_t span_at(double time) noexcept;

/// Where a body is at the samples. Rows are not set before somebody does.
struct PoseSamples {
  alignas(32) SampleRow x;       ///< of the footprint's middle, from an origin, along W [m]
  alignas(32) SampleRow y;       ///< likewise [m]
  alignas(32) SampleRow cosine;  ///< of its direction in W
  alignas(32) SampleRow sine;    ///< likewise
  alignas(32) SampleRow turn;    ///< most that it turns in this span or one beside it, about [rad]
  Vec2 half;                     ///< axes of the footprint [m]
  double from = 0.0;             ///< its track begins [s since the scene's time]
  double end = 0.0;              ///< and ends
  bool goes = false;             ///< moves where the track ends
  double reach = 0.0;            ///< of the footprint from its middle [m]
  /// Rectangles that hold the middle during each group of spans.
  alignas(32) std::array<float, num_groups> low_x;
  alignas(32) std::array<float, num_groups> low_y;
  alignas(32) std::array<float, num_groups> high_x;
  alignas(32) std::array<float, num_groups> high_y;
};

/// Cosine and sine of an angle: to 1e-6 up to pi, to 1e-3 up to a whole turn [rad].
inline void direction(float angle, float& cosine, float& sine) noexcept {
  const float q = 0.25F * angle;  // of the quarter, doubled twice
  const float z = q * q;
  float s = q * (1.0F - z / 6.0F * (1.0F - z / 20.0F * (1.0F - z / 42.0F)));
  float c = 1.0F - z / 2.0F * (1.0F - z / 12.0F * (1.0F - z / 30.0F * (1.0F - z / 56.0F)));
  for (int i = 0; i < 2; ++i) {
    const float twice = 2.0F * s * c;
    c = 1.0F - 2.0F * s * s;
    s = twice;
  }
  cosine = c;
  sine = s;
}

/// What follows from place and direction: turn, half, reach and the rectangles.
/// @param level  available; the numbers are the same on each
void complete(PoseSamples& samples, const world::Footprint& footprint,
              SimdLevel level = best_level()) noexcept;

/// Of a body on a track; before it starts and after it ends it stands.
/// @param start     the scene's time [s]
/// @param origin_W  [m]
[[nodiscard]] PoseSamples pose_samples_of(const world::Track& track,
                                          const world::Footprint& footprint, double start,
                                          Vec2 origin_W) noexcept;

/// How near two bodies may be to each other during each group of spans: never more than they are.
[[nodiscard]] std::array<float, num_groups> group_gaps(const PoseSamples& a,
                                                       const PoseSamples& b) noexcept;

/// Two bodies at the samples, each as the box around it.
struct PairSamples {
  alignas(32) SampleRow gap;    ///< along the axes of both boxes, at each sample [m]
  alignas(32) SampleRow n_x;    ///< the direction of that gap, from a to b, in W
  alignas(32) SampleRow n_y;    ///< likewise
  alignas(32) SampleRow least;  ///< gaps within the span are not smaller [m]
  /// Along the length and width of `a`, then of `b`, at each sample.
  alignas(32) std::array<SampleRow, 4> apart;  ///< of the middles, positive where b lies ahead [m]
  alignas(32) std::array<SampleRow, 4> reach;  ///< of both [m]
  alignas(32) SampleRow slack;  ///< the ways' bulges and turns within the span cost no gap more [m]
};

/// The least gap along an axis that there can be between two samples, slack apart [m].
/// @param apart  of the middles along it, signed
/// @param reach  of both bodies
[[nodiscard]] inline float narrowest_along(float apart, float reach, float next_apart,
                                           float next_reach) noexcept {
  const float nearer = std::min(std::abs(apart), std::abs(next_apart));
  return (apart * next_apart > 0.0F ? nearer : 0.0F) - std::max(reach, next_reach);
}

/// Fills `near` for the groups from `first` to `last`, and the sample behind them. Velocities that
/// change by more than 20 m/s^2 against each other, or all at once within a span, may deceive it.
/// @param level  available; the numbers are the same on each
void compare_samples(const PoseSamples& a, const PoseSamples& b, std::size_t first,
                     std::size_t last, PairSamples& near, SimdLevel level = best_level()) noexcept;

}  // namespace saca::forecast
