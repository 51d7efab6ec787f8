#include "saca/outcome/likeliest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace saca::outcome {
namespace {

constexpr float nowhere = -1e29F;  // gap of what is no number [m]

double normal_below(double x) noexcept {
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

// How many standard deviations of the gap are between them at the looks of a window.
struct Scores {
  LookRow score;  // infinite outside of its time
  LookRow mean;   // that is added to the gap [m]
  LookRow per_sd;
  double least = 0.0;  // of no score within the window, between the looks too

  [[nodiscard]] double of(float gap, std::size_t k) const noexcept {
    return static_cast<double>((gap + mean[k]) * per_sd[k]);
  }
};

void spread_at(const CloserLook& pair, const Window& window, const NearLooks& near,
               Scores& scores) noexcept {
  const auto place_sd = static_cast<float>(pair.actor().position_sd);
  const auto speed_sd = static_cast<float>(pair.actor().velocity_sd);
  const std::size_t end = window.end() + spans_per_group;
  for (std::size_t k = window.begin(); k < end; ++k) {
    const float moved = speed_sd * look_times[k];
    scores.mean[k] = 0.0F;
    scores.per_sd[k] = place_sd * place_sd + moved * moved;
  }
  if (pair.ego().scene().grip_sd > 0.0) {
    const AtlasEgo::SwayLooks& sway = pair.ego().sway_looks();
    constexpr float mean_share = 0.3989423F;  // 1 / sqrt(2 pi), as in of_halves
    for (std::size_t k = window.begin(); k < end; ++k) {
      const float less = near.n_x[k] * sway.less_x[k] + near.n_y[k] * sway.less_y[k];
      const float more = near.n_x[k] * sway.more_x[k] + near.n_y[k] * sway.more_y[k];
      scores.mean[k] = -mean_share * (less + more);
      scores.per_sd[k] += 0.5F * (less * less + more * more) - scores.mean[k] * scores.mean[k];
    }
  }
  constexpr auto least_variance = static_cast<float>(least_sd * least_sd);
  for (std::size_t k = window.begin(); k < end; ++k) {
    scores.per_sd[k] = 1.0F / std::sqrt(std::max(scores.per_sd[k], least_variance));
  }
}

void fill(const CloserLook& pair, const Window& window, const NearLooks& near,
          Scores& scores) noexcept {
  spread_at(pair, window, near, scores);
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    const float lowest = near.least[k] + std::min(scores.mean[k], scores.mean[k + 1]);
    const float per_sd = lowest > 0.0F ? std::min(scores.per_sd[k], scores.per_sd[k + 1])
                                       : std::max(scores.per_sd[k], scores.per_sd[k + 1]);
    least = std::min(least, lowest * per_sd);
  }
  scores.least = static_cast<double>(least);
  const auto from = static_cast<float>(window.from);
  const auto to = static_cast<float>(window.to);
  for (std::size_t k = window.begin(); k <= window.end(); ++k) {
    const bool inside = look_times[k] >= from && look_times[k] <= to && near.gap[k] > nowhere;
    scores.score[k] = inside ? (near.gap[k] + scores.mean[k]) * scores.per_sd[k]
                             : std::numeric_limits<float>::infinity();
  }
}

// Where the widest gap is along one axis before and along another after: there the score has a
// step or a valley.
struct Turn {
  std::size_t span = 0;
  double time = 0.0;   // about [s]
  double score = 0.0;  // about
};

// Of a span: where the lines of the gap on both sides cross.
std::optional<Turn> turn_in(const Window& window, const NearLooks& near, const Scores& scores,
                            std::size_t k) noexcept {
  const float alike = near.n_x[k] * near.n_x[k + 1] + near.n_y[k] * near.n_y[k + 1];
  const bool seen = std::isfinite(scores.score[k]) && std::isfinite(scores.score[k + 1]);
  if (alike > 0.9F || !seen) {
    return std::nullopt;
  }
  const float span = look_times[k + 1] - look_times[k];
  float falls = 0.0F;
  float rises = 0.0F;
  if (k > window.begin()) {
    falls = (near.gap[k] - near.gap[k - 1]) / (look_times[k] - look_times[k - 1]);
  }
  if (k + 2 <= window.end()) {
    rises = (near.gap[k + 2] - near.gap[k + 1]) / (look_times[k + 2] - look_times[k + 1]);
  }
  const float after = (near.gap[k + 1] - near.gap[k] - rises * span) / (falls - rises);
  const float inside = after > 0.0F && after < span ? after : 0.5F * span;
  const float gap = near.gap[k] + falls * inside;
  return Turn{k, look_time(k) + static_cast<double>(inside),
              std::min(scores.of(gap, k), scores.of(gap, k + 1))};
}

// Looks on both sides of a turn, ever closer to it.
template <class Keep>
void look_beside(const CloserLook& pair, const NearLooks& near, const Turn& turn,
                 const Keep& keep) noexcept {
  const std::size_t k = turn.span;
  double low = look_time(k);
  double high = look_time(k + 1);
  double time = turn.time;
  double step = 0.02;  // [s]
  for (int i = 0; i < 4; ++i) {
    const CloserLook::Look now = pair.look(time);
    keep(now);
    const auto along = [&](std::size_t at) {
      return now.gap.n.x * static_cast<double>(near.n_x[at]) +
             now.gap.n.y * static_cast<double>(near.n_y[at]);
    };
    const bool before = along(k) > along(k + 1);
    (before ? low : high) = time;
    const double middle = 0.5 * (low + high);
    time = before ? std::min(time + step, middle) : std::max(time - step, middle);
    step *= 0.5;
  }
}

}  // namespace

void find_likeliest(const CloserLook& pair, const Window& window, const NearLooks& near,
                    Meeting& found) noexcept {
  if (!window.any) {
    return;
  }
  Scores scores;
  fill(pair, window, near, scores);
  if (scores.least > sure_sd) {
    return;
  }
  const auto likeliest =
      static_cast<std::size_t>(std::min_element(scores.score.begin() + window.begin(),
                                                scores.score.begin() + window.end() + 1) -
                               scores.score.begin());
  const auto at_look = static_cast<double>(scores.score[likeliest]);
  if (at_look < -sure_sd - 1.0) {
    found.probability = normal_below(-at_look);
    found.nearest = look_time(likeliest);
    return;
  }
  double best = std::numeric_limits<double>::infinity();
  const auto keep = [&](const CloserLook::Look& now) {
    const double score = pair.score(now);
    if (!(score < best)) {
      return false;
    }
    best = score;
    found.nearest = now.time;
    found.gap = now.gap.size;
    found.n_W = now.gap.n;
    return true;
  };
  std::optional<Turn> deepest;
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    const auto turn = turn_in(window, near, scores, k);
    deepest = turn && (!deepest || turn->score < deepest->score) ? turn : deepest;
  }
  if (deepest && deepest->score < at_look) {
    look_beside(pair, near, *deepest, keep);
  }
  if (!(best < at_look)) {
    narrow(window, likeliest, 4, [&](double time) { return keep(pair.look(time)); });
  }
  if (found.contact && best > 0.0) {
    keep(pair.look(*found.contact));
  }
  found.probability = normal_below(-best);
}

}  // namespace saca::outcome
