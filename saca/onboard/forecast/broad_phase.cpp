#include "saca/onboard/forecast/broad_phase.h"

#include <algorithm>
#include <cmath>

namespace saca::forecast {
namespace {

constexpr double bends_by = 20.0;  // of the two velocities against each other [m/s^2]
constexpr double standing = 0.05;  // what stands at two samples is within this between them [m]

// How far a way may bulge from the straight line between its ends [m].
constexpr SampleRow bulges() {
  SampleRow row{};
  for (std::size_t k = 0; k < num_spans; ++k) {
    const double span = sample_time(k + 1) - sample_time(k);
    row[k] = static_cast<float>(0.125 * bends_by * span * span);
  }
  return row;
}
constexpr SampleRow bulge_in = bulges();

// The gap along one axis of one of two boxes.
struct Axis {
  float apart;  // of the middles, signed
  float reach;  // of both
};
inline void keep_wider(const Axis& axis, float n_x, float n_y, float& gap, float& x,
                       float& y) noexcept {
  const float size = std::abs(axis.apart) - axis.reach;
  const bool wider = size > gap;
  const float sign = axis.apart < 0.0F ? -1.0F : 1.0F;
  gap = wider ? size : gap;
  x = wider ? sign * n_x : x;
  y = wider ? sign * n_y : y;
}

}  // namespace

std::size_t span_at(double time) noexcept {
  const double k = time < 3.2 ? time / 0.2 : time < 9.6 ? (time + 3.2) / 0.4 : (time + 41.6) / 1.6;
  return std::min(num_spans, static_cast<std::size_t>(std::clamp(k, 0.0, 1e3)));
}

namespace {

[[gnu::always_inline]] inline void fill_turns(PoseSamples& samples) noexcept {
  SampleRow turn;
  for (std::size_t k = 0; k < num_spans; ++k) {
    turn[k] =
        std::abs(samples.sine[k + 1] * samples.cosine[k] - samples.cosine[k + 1] * samples.sine[k]);
  }
  turn[num_spans] = 0.0F;
  samples.turn[0] = std::max(turn[0], turn[1]);
  for (std::size_t k = 1; k < num_spans; ++k) {
    samples.turn[k] = std::max(turn[k - 1], std::max(turn[k], turn[k + 1]));
  }
}

// The least and the largest of each group's samples, the one behind it included.
[[gnu::always_inline]] inline void bound(const SampleRow& row, std::array<float, num_groups>& low,
                                         std::array<float, num_groups>& high) noexcept {
  for (std::size_t g = 0; g < num_groups; ++g) {
    const float* const at = row.data() + g * spans_per_group;
    low[g] = std::min(std::min(std::min(at[0], at[1]), std::min(at[2], at[3])), at[4]);
    high[g] = std::max(std::max(std::max(at[0], at[1]), std::max(at[2], at[3])), at[4]);
  }
}

[[gnu::always_inline]] inline void complete_all(PoseSamples& samples,
                                                const world::Footprint& footprint) noexcept {
  samples.half = half_axes(footprint);
  samples.reach = std::sqrt(dot(samples.half, samples.half));
  fill_turns(samples);
  bound(samples.x, samples.low_x, samples.high_x);
  bound(samples.y, samples.low_y, samples.high_y);
  for (std::size_t g = 0; g < num_groups; ++g) {
    const float extent =
        samples.high_x[g] - samples.low_x[g] + samples.high_y[g] - samples.low_y[g];
    const float bulge =
        std::min(bulge_in[g * spans_per_group], static_cast<float>(standing) + 0.5F * extent);
    samples.low_x[g] -= bulge;
    samples.low_y[g] -= bulge;
    samples.high_x[g] += bulge;
    samples.high_y[g] += bulge;
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void complete_in_avx2(PoseSamples& samples,
                                              const world::Footprint& footprint) noexcept {
  complete_all(samples, footprint);
}
#endif

}  // namespace

void complete(PoseSamples& samples, const world::Footprint& footprint,
              [[maybe_unused]] SimdLevel level) noexcept {
#if defined(__x86_64__)
  if (level != SimdLevel::baseline) {
    complete_in_avx2(samples, footprint);
    return;
  }
#endif
  complete_all(samples, footprint);
}

PoseSamples pose_samples_of(const world::Track& track, const world::Footprint& footprint,
                            double start, Vec2 origin_W) noexcept {
  PoseSamples samples;
  SampleRow yaw{};
  const double per_second = 1.0 / track.step;
  const auto last = static_cast<double>(track.X_WA.size() - 1);
  std::array<double, num_spans + 1> places;
  std::size_t on_track = 0;  // samples
  for (; on_track <= num_spans; ++on_track) {
    const double place = std::max((start + sample_time(on_track) - track.start) * per_second, 0.0);
    if (place >= last) {
      break;
    }
    places[on_track] = place;
    // The poses lie far from each other: fetched all at once, none is waited for alone.
    __builtin_prefetch(&track.X_WA[static_cast<std::size_t>(place)]);
  }
  std::size_t k = 0;
  for (; k < on_track; ++k) {
    const double place = places[k];
    const auto i = static_cast<std::size_t>(place);
    const Pose& a = track.X_WA[i];
    const Pose& b = track.X_WA[i + 1];
    const double share = place - static_cast<double>(i);
    samples.x[k] = static_cast<float>(a.p.x + share * (b.p.x - a.p.x) - origin_W.x);
    samples.y[k] = static_cast<float>(a.p.y + share * (b.p.y - a.p.y) - origin_W.y);
    const double turned = a.yaw + share * (a.yaw == b.yaw ? 0.0 : wrap_angle(b.yaw - a.yaw));
    yaw[k] = static_cast<float>(wrap_angle(turned));
  }
  const Pose& end = track.X_WA.back();
  for (; k < yaw.size(); ++k) {
    samples.x[k] = static_cast<float>(end.p.x - origin_W.x);
    samples.y[k] = static_cast<float>(end.p.y - origin_W.y);
    yaw[k] = static_cast<float>(wrap_angle(end.yaw));
  }
  const auto ahead = static_cast<float>(footprint.centre_x);
  for (std::size_t i = 0; i < yaw.size(); ++i) {
    direction(yaw[i], samples.cosine[i], samples.sine[i]);
    samples.x[i] += ahead * samples.cosine[i];
    samples.y[i] += ahead * samples.sine[i];
  }
  constexpr double still = 0.05;  // [m/s]
  samples.from = track.start - start;
  samples.end = samples.from + last * track.step;
  samples.goes =
      track.X_WA.size() > 1 &&
      norm(track.X_WA.back().p - track.X_WA[track.X_WA.size() - 2].p) > still * track.step;
  complete(samples, footprint);
  return samples;
}

std::array<float, num_groups> group_gaps(const PoseSamples& a, const PoseSamples& b) noexcept {
  std::array<float, num_groups> gaps{};
  const auto reach = static_cast<float>(a.reach + b.reach);
  for (std::size_t g = 0; g < num_groups; ++g) {
    const float x = std::max(b.low_x[g] - a.high_x[g], a.low_x[g] - b.high_x[g]);
    const float y = std::max(b.low_y[g] - a.high_y[g], a.low_y[g] - b.high_y[g]);
    const float dx = std::max(x, 0.0F);
    const float dy = std::max(y, 0.0F);
    gaps[g] = std::sqrt(dx * dx + dy * dy) - reach;
  }
  return gaps;
}

namespace {

// Along the axes of both boxes: how far apart the middles are, and how far both reach. `size` is
// that of the way between the middles, about.
[[gnu::always_inline]] inline void fill_axes_of_boxes(const PoseSamples& a, const PoseSamples& b,
                                                      const SampleRange& range, PairSamples& near,
                                                      SampleRow& size) noexcept {
  const auto a_x = static_cast<float>(a.half.x);
  const auto a_y = static_cast<float>(a.half.y);
  const auto b_x = static_cast<float>(b.half.x);
  const auto b_y = static_cast<float>(b.half.y);
  auto& apart = near.apart;
  auto& reach = near.reach;
  for (std::size_t k = range.begin; k < range.end + spans_per_group; ++k) {
    const float x = b.x[k] - a.x[k];
    const float y = b.y[k] - a.y[k];
    const float c = std::abs(a.cosine[k] * b.cosine[k] + a.sine[k] * b.sine[k]);
    const float s = std::abs(a.cosine[k] * b.sine[k] - a.sine[k] * b.cosine[k]);
    apart[0][k] = x * a.cosine[k] + y * a.sine[k];
    apart[1][k] = y * a.cosine[k] - x * a.sine[k];
    apart[2][k] = x * b.cosine[k] + y * b.sine[k];
    apart[3][k] = y * b.cosine[k] - x * b.sine[k];
    reach[0][k] = a_x + b_x * c + b_y * s;
    reach[1][k] = a_y + b_x * s + b_y * c;
    reach[2][k] = b_x + a_x * c + a_y * s;
    reach[3][k] = b_y + a_x * s + a_y * c;
    size[k] = std::abs(x) + std::abs(y);
  }
}

[[gnu::always_inline]] inline void fill_gaps(const PoseSamples& a, const PoseSamples& b,
                                             const SampleRange& range, PairSamples& near) noexcept {
  const auto& apart = near.apart;
  const auto& reach = near.reach;
  for (std::size_t k = range.begin; k < range.end + spans_per_group; ++k) {
    float gap = -1e30F;
    float x = 0.0F;
    float y = 0.0F;
    keep_wider({apart[0][k], reach[0][k]}, a.cosine[k], a.sine[k], gap, x, y);
    keep_wider({apart[1][k], reach[1][k]}, -a.sine[k], a.cosine[k], gap, x, y);
    keep_wider({apart[2][k], reach[2][k]}, b.cosine[k], b.sine[k], gap, x, y);
    keep_wider({apart[3][k], reach[3][k]}, -b.sine[k], b.cosine[k], gap, x, y);
    near.gap[k] = gap;
    near.n_x[k] = x;
    near.n_y[k] = y;
  }
}

// Bounds of the gap from one sample to the next.
[[gnu::always_inline]] inline void bound_gaps(const PoseSamples& a, const PoseSamples& b,
                                              const SampleRange& range, const SampleRow& size,
                                              PairSamples& near) noexcept {
  const auto& apart = near.apart;
  const auto& reach = near.reach;
  const auto corners = static_cast<float>(a.reach + b.reach);
  for (std::size_t k = range.begin; k < range.end; ++k) {
    float least = -1e30F;
    for (std::size_t i = 0; i < 4; ++i) {
      least = std::max(least,
                       narrowest_along(apart[i][k], reach[i][k], apart[i][k + 1], reach[i][k + 1]));
    }
    const float turn = a.turn[k] + b.turn[k];
    const float moved = std::abs(b.x[k + 1] - b.x[k] - a.x[k + 1] + a.x[k]) +
                        std::abs(b.y[k + 1] - b.y[k] - a.y[k + 1] + a.y[k]);
    const float bulge = std::min(bulge_in[k], static_cast<float>(standing) + 0.5F * moved);
    // Axes that turn by d, evenly or not, sway what lies r away by r d / 8, and what moves along
    // by a quarter of d times its way.
    const float sway = 0.125F * turn * (1.0F + turn) * (size[k] + corners);
    near.slack[k] = bulge + sway + 0.25F * turn * moved;
    near.least[k] = least - bulge - sway - 0.25F * turn * moved;
  }
}

[[gnu::always_inline]] inline void compare_all_samples(const PoseSamples& a, const PoseSamples& b,
                                                       std::size_t first, std::size_t last,
                                                       PairSamples& near) noexcept {
  // Of spans: there is a sample behind the last, and rows are filled by whole groups.
  const SampleRange range{first * spans_per_group, (last + 1) * spans_per_group};
  SampleRow size;
  fill_axes_of_boxes(a, b, range, near, size);
  fill_gaps(a, b, range, near);
  bound_gaps(a, b, range, size, near);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void compare_samples_in_avx2(const PoseSamples& a, const PoseSamples& b,
                                                     std::size_t first, std::size_t last,
                                                     PairSamples& near) noexcept {
  compare_all_samples(a, b, first, last, near);
}
#endif

}  // namespace

// The same numbers on each instruction set: no operation is fused or put in another order.
void compare_samples(const PoseSamples& a, const PoseSamples& b, std::size_t first,
                     std::size_t last, PairSamples& near,
                     [[maybe_unused]] SimdLevel level) noexcept {
#if defined(__x86_64__)
  if (level != SimdLevel::baseline) {
    compare_samples_in_avx2(a, b, first, last, near);
    return;
  }
#endif
  compare_all_samples(a, b, first, last, near);
}

}  // namespace saca::forecast
