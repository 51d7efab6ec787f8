#include "saca/onboard/forecast/likeliest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/core/simd_level.h"

namespace saca::forecast {
namespace {

constexpr float nowhere = -1e29F;  // gap of what is no number [m]
constexpr std::size_t num_axes = 4;

double normal_below(double x) noexcept {
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

// How many standard deviations of the gap are between them along each axis, at the samples.
struct ScoreRows {
  alignas(32) std::array<SampleRow, num_axes> of_axis;
  alignas(32) SampleRow most;   // of the axes
  alignas(32) SampleRow bound;  // within the span no largest score is smaller
};

// How far the actor may be from its track at the samples.
struct ActorRows {
  alignas(32) SampleRow along;  // variances [m^2]
  alignas(32) SampleRow across;
};

// Along one axis: what is added to the gap, and to how many standard deviations it is then.
struct SpreadRows {
  alignas(32) SampleRow mean;  // [m]
  alignas(32) SampleRow per_sd;
};

void fill_actor(const NarrowPhase& pair, const SampleRange& range, ActorRows& actor) noexcept {
  for (std::size_t k = range.begin; k < range.end; ++k) {
    const world::Spread spread = pair.actor_spread(sample_time(k));
    actor.along[k] = static_cast<float>(spread.along_sd * spread.along_sd);
    actor.across[k] = static_cast<float>(spread.across_sd * spread.across_sd);
  }
}

// Refers to directions, and to how far apart the middles are along them.
struct AxisRows {
  const SampleRow& n_x;
  const SampleRow& n_y;
  const SampleRow& apart;
};

[[gnu::always_inline]] inline void spread_along(const AxisRows& axis, const NarrowPhase& pair,
                                                const ActorRows& actor, const SampleRange& range,
                                                SpreadRows& spread) noexcept {
  const auto& [n_x, n_y, apart] = axis;
  const AtlasEgo::SensitivityAtSamples& sensitivity = pair.ego().sensitivity_at_samples();
  const PoseSamples& other = pair.samples();
  constexpr float mean_share = 0.3989423F;  // 1 / sqrt(2 pi), as in of_halves
  constexpr auto least_variance = static_cast<float>(least_sd * least_sd);
  for (std::size_t k = range.begin; k < range.end; ++k) {
    const float less = n_x[k] * sensitivity.less_x[k] + n_y[k] * sensitivity.less_y[k];
    const float more = n_x[k] * sensitivity.more_x[k] + n_y[k] * sensitivity.more_y[k];
    const float mean = mean_share * (less + more);
    const float n_along = n_x[k] * other.cosine[k] + n_y[k] * other.sine[k];
    const float n_across = n_y[k] * other.cosine[k] - n_x[k] * other.sine[k];
    const float of_actor =
        actor.along[k] * n_along * n_along + actor.across[k] * n_across * n_across;
    const float variance = of_actor + 0.5F * (less * less + more * more) - mean * mean;
    spread.mean[k] = apart[k] < 0.0F ? mean : -mean;
    spread.per_sd[k] = 1.0F / std::sqrt(std::max(variance, least_variance));
  }
}

[[gnu::always_inline]] inline void fill_axis(std::size_t axis, const NarrowPhase& pair,
                                             const ActorRows& actor, const SampleRange& range,
                                             const PairSamples& near, ScoreRows& rows) noexcept {
  const PoseSamples& body = axis < 2 ? pair.ego().samples() : pair.samples();
  const SampleRow& apart = near.apart[axis];
  const SampleRow& reach = near.reach[axis];
  SampleRow left_x;  // of what samples along its length
  SpreadRows spread;
  if (axis % 2 == 0) {
    spread_along({body.cosine, body.sine, apart}, pair, actor, range, spread);
  } else {
    for (std::size_t k = range.begin; k < range.end; ++k) {
      left_x[k] = -body.sine[k];
    }
    spread_along({left_x, body.cosine, apart}, pair, actor, range, spread);
  }
  for (std::size_t k = range.begin; k < range.end; ++k) {
    const float score = (std::abs(apart[k]) - reach[k] + spread.mean[k]) * spread.per_sd[k];
    rows.of_axis[axis][k] = score;
    rows.most[k] = std::max(rows.most[k], score);
  }
  for (std::size_t k = range.begin; k + spans_per_group < range.end; ++k) {
    const float gap =
        narrowest_along(apart[k], reach[k], apart[k + 1], reach[k + 1]) - near.slack[k];
    const float lowest = gap + std::min(spread.mean[k], spread.mean[k + 1]);
    const float fewest = std::min(spread.per_sd[k], spread.per_sd[k + 1]);
    const float highest = std::max(spread.per_sd[k], spread.per_sd[k + 1]);
    rows.bound[k] = std::max(rows.bound[k], lowest * (lowest > 0.0F ? fewest : highest));
  }
}

[[gnu::always_inline]] inline void fill_axes(const NarrowPhase& pair, const ActorRows& actor,
                                             const SampleRange& range, const PairSamples& near,
                                             ScoreRows& rows) noexcept {
  rows.most.fill(-std::numeric_limits<float>::infinity());
  rows.bound.fill(-std::numeric_limits<float>::infinity());
  for (std::size_t axis = 0; axis < num_axes; ++axis) {
    fill_axis(axis, pair, actor, range, near, rows);
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fill_axes_in_avx2(const NarrowPhase& pair, const ActorRows& actor,
                                               const SampleRange& range, const PairSamples& near,
                                               ScoreRows& rows) noexcept {
  fill_axes(pair, actor, range, near, rows);
}
#endif

// The same numbers on each instruction set: no operation is fused or put in another order.
void fill_all(const NarrowPhase& pair, const SampleRange& range, const PairSamples& near,
              ScoreRows& rows) noexcept {
  ActorRows actor;
  fill_actor(pair, range, actor);
#if defined(__x86_64__)
  if (best_level() != SimdLevel::baseline) {
    fill_axes_in_avx2(pair, actor, range, near, rows);
    return;
  }
#endif
  fill_axes(pair, actor, range, near, rows);
}

// What is outside of its time, or no number, is infinitely unlikely. Returns the least bound.
float fill(const NarrowPhase& pair, const Window& window, const PairSamples& near,
           ScoreRows& rows) noexcept {
  fill_all(pair, {window.begin(), window.end() + spans_per_group}, near, rows);
  constexpr float never = std::numeric_limits<float>::infinity();
  float least = never;
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    const bool seen = window.holds(k) && near.gap[k] > nowhere && near.gap[k + 1] > nowhere;
    if (!seen) {
      rows.bound[k] = never;
    }
    least = std::min(least, rows.bound[k]);
  }
  const auto from = static_cast<float>(window.from);
  const auto to = static_cast<float>(window.to);
  for (std::size_t k = window.begin(); k <= window.end(); ++k) {
    const bool inside = sample_times[k] >= from && sample_times[k] <= to && near.gap[k] > nowhere;
    if (!inside) {
      rows.most[k] = never;
    }
  }
  return least;
}

// The scores along all axes at one time.
struct End {
  double time = 0.0;  // [s]
  std::array<NarrowPhase::Score, num_axes> of_axis;
};

End end_at(const NarrowPhase& pair, const PairSamples& near, const ScoreRows& rows,
           std::size_t k) noexcept {
  End end{.time = sample_time(k), .of_axis = {}};
  for (std::size_t axis = 0; axis < num_axes; ++axis) {
    const PoseSamples& body = axis < 2 ? pair.ego().samples() : pair.samples();
    const Vec2 along{static_cast<double>(body.cosine[k]), static_cast<double>(body.sine[k])};
    const Vec2 n = axis % 2 == 0 ? along : collision::left_of(along);
    end.of_axis[axis] = {static_cast<double>(rows.of_axis[axis][k]),
                         near.apart[axis][k] < 0.0F ? -n : n};
  }
  return end;
}

// Where the largest score is least, each axis' a straight line between two times. An axis that the
// one passes from behind to ahead of the other tells nothing.
struct Valley {
  double time = 0.0;
  double score = std::numeric_limits<double>::infinity();
};

Valley valley_between(const End& low, const End& high, const Window& window) noexcept {
  const double span = high.time - low.time;
  const double first = std::max(0.0, (window.from - low.time) / span);
  const double last = std::min(1.0, (window.to - low.time) / span);
  std::array<double, num_axes> from{};
  std::array<double, num_axes> rise{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < num_axes; ++i) {
    if (dot(low.of_axis[i].n, high.of_axis[i].n) > 0.0) {
      from[count] = low.of_axis[i].size;
      rise[count] = high.of_axis[i].size - low.of_axis[i].size;
      ++count;
    }
  }
  Valley least{.time = low.time + 0.5 * (first + last) * span};
  if (count == 0) {
    least.score = -std::numeric_limits<double>::infinity();
    return least;
  }
  const auto sample = [&](double share) {
    if (!(share >= first && share <= last)) {
      return;
    }
    double most = from[0] + share * rise[0];
    for (std::size_t i = 1; i < count; ++i) {
      most = std::max(most, from[i] + share * rise[i]);
    }
    least = most < least.score ? Valley{low.time + share * span, most} : least;
  };
  sample(first);
  sample(last);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      sample((from[i] - from[j]) / (rise[j] - rise[i]));
    }
  }
  return least;
}

struct ValleyInSpan {
  Valley valley;
  std::size_t span = 0;
};

// The deepest of the spans whose bound is below `low`.
ValleyInSpan deepest_valley(const NarrowPhase& pair, const Window& window, const PairSamples& near,
                            const ScoreRows& rows, double low) noexcept {
  ValleyInSpan deepest;
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    if (static_cast<double>(rows.bound[k]) < low) {
      const Valley valley =
          valley_between(end_at(pair, near, rows, k), end_at(pair, near, rows, k + 1), window);
      deepest = valley.score < deepest.valley.score ? ValleyInSpan{valley, k} : deepest;
    }
  }
  return deepest;
}

// Of all that were looked at, the one at which they most likely touch.
struct LikeliestState {
  const NarrowPhase& pair;
  double best = std::numeric_limits<double>::infinity();  // its score
  NarrowPhase::PairState passing;

  NarrowPhase::Scores keep(double time) noexcept {
    const NarrowPhase::PairState now = pair.state_at(time);
    const NarrowPhase::Scores scores = pair.scores(now);
    if (scores.most < best) {
      best = scores.most;
      passing = now;
    }
    return scores;
  }
};

// Looks where the lines of the scores meet lowest, and again between what was looked at.
template <class Keep>
void look_into(const Window& window, End low, End high, Valley valley, const Keep& keep) noexcept {
  constexpr double close = 0.05;  // standard deviations
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const NarrowPhase::Scores now = keep(valley.time);
    best = std::min(best, now.most);
    const End middle{valley.time, now.of_axis};
    const bool inside = middle.time > low.time && middle.time < high.time;
    if (!inside || now.most < valley.score + close) {
      return;
    }
    const Valley before = valley_between(low, middle, window);
    const Valley after = valley_between(middle, high, window);
    (before.score < after.score ? high : low) = middle;
    valley = before.score < after.score ? before : after;
    if (!(valley.score < best - close)) {
      return;
    }
  }
}

// The first touch of the other when it is nearer by what is typical of those who touch.
// @param passing  the likeliest instant; the gap then is > 0
void find_touch(const NarrowPhase& pair, const NarrowPhase::PairState& passing, double from,
                ContactForecast& found) noexcept {
  constexpr double near = 1e-5;  // [m]: bodies that touch
  const NarrowPhase::Doubt doubt = pair.doubt(passing);
  Vec2 nearer;
  const auto gap_at = [&](double time) {
    NarrowPhase::PairState now = pair.state_at(time);
    now.other.centre = now.other.centre + nearer;
    return collision::gap_between(now.mine, now.other);
  };
  // Apart along one direction they may be along another too: each has to be overcome.
  collision::Gap gap = passing.gap;
  for (int i = 0; i < 3 && gap.size > 0.0; ++i, gap = gap_at(passing.time)) {
    const Moments along = doubt.nearer(gap.n);
    const double sd = std::sqrt(along.variance);
    const double sds = (gap.size - along.mean) / sd;
    const double density = std::exp(-0.5 * sds * sds) * 0.3989422804;
    const double mean_of_touching = along.mean + sd * density / normal_below(-sds);
    nearer = nearer + mean_of_touching * doubt.displacement_per_metre(gap.n);
  }
  constexpr double step = 0.05;  // [s]
  double touching = passing.time;
  double apart = std::max(from, touching - step);
  while (gap_at(apart).size <= 0.0) {
    touching = apart;
    if (apart <= from) {
      break;  // they touch from the start on
    }
    apart = std::max(from, touching - step);
  }
  for (int i = 0; i < 5 && apart < touching; ++i) {
    const double middle = 0.5 * (apart + touching);
    (gap_at(middle).size > 0.0 ? apart : touching) = middle;
  }
  const collision::Gap left = gap_at(touching);
  found.touch = touching;
  found.brought_W = nearer - (left.size - near) * left.n;
}

}  // namespace

void find_likeliest(const NarrowPhase& pair, const Window& window, const PairSamples& near,
                    ContactForecast& found) noexcept {
  if (!window.any) {
    return;
  }
  ScoreRows rows;
  if (static_cast<double>(fill(pair, window, near, rows)) > sure_sd) {
    return;
  }
  const auto likeliest = static_cast<std::size_t>(
      std::min_element(rows.most.begin() + window.begin(), rows.most.begin() + window.end() + 1) -
      rows.most.begin());
  const auto at_sample = static_cast<double>(rows.most[likeliest]);
  if (at_sample < -sure_sd - 1.0) {
    found.probability = normal_below(-at_sample);
    found.touch = sample_time(likeliest);
    return;
  }
  LikeliestState state{.pair = pair, .passing = {}};
  const double& best = state.best;
  const auto keep = [&](double time) { return state.keep(time); };
  const double low = std::min(at_sample, sure_sd);
  const auto [deepest, span] = deepest_valley(pair, window, near, rows, low);
  if (deepest.score < low) {
    look_into(window, end_at(pair, near, rows, span), end_at(pair, near, rows, span + 1), deepest,
              keep);
  }
  if (!(best < at_sample)) {
    narrow(window, likeliest, 4, [&](double time) {
      const double before = best;
      return keep(time).most < before;
    });
  }
  if (found.contact && best > 0.0) {
    keep(*found.contact);
  }
  found.probability = normal_below(-best);
  if (found.contact) {
    return;
  }
  const NarrowPhase::PairState& passing = state.passing;
  found.touch = passing.time;
  if (found.probability > negligible && best > 0.0 && passing.gap.size > 0.0) {
    find_touch(pair, passing, window.from, found);
  }
}

}  // namespace saca::forecast
