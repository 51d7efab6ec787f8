#include "saca/outcome/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/outcome/false_position.h"
#include "saca/outcome/gap.h"
#include "saca/world/footprint.h"

namespace saca::outcome {
namespace {

using world::Shape;
using world::Track;

constexpr double least_step = 0.01;   // [s]
constexpr double most_change = 20.0;  // of the two velocities against each other [m/s^2]
constexpr double jump = 1.0;          // that a walker's track may make at once [m/s]
constexpr double sure_sd = 4.0;       // beyond so many standard deviations nothing happens
constexpr double least_sd = 1e-3;     // [m]
// Apart by so little two bodies touch: less, and where they touch is slow to find [m].
constexpr double near_touch = 5e-6;
constexpr float nowhere = -1e29F;  // gap of what is no number [m]
constexpr double endless = std::numeric_limits<double>::infinity();

double normal_below(double x) noexcept {
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

// A track at one time, found once.
struct OnTrack {
  Pose X_WA;
  Vec2 v_W;
  double yaw_rate = 0.0;
};
OnTrack on_track(const Track& track, double time) noexcept {
  const auto last = static_cast<double>(track.X_WA.size() - 1);
  const double place = (time - track.start) / track.step;
  if (!(place >= 0.0 && place <= last) || last < 1.0) {
    return {place > 0.0 ? track.X_WA.back() : track.X_WA.front(), {}, 0.0};
  }
  const std::size_t i = std::min(static_cast<std::size_t>(place), track.X_WA.size() - 2);
  const double u = place - static_cast<double>(i);
  const Pose& a = track.X_WA[i];
  const Pose& b = track.X_WA[i + 1];
  const Vec2 way = b.p - a.p;
  const double turn = wrap_angle(b.yaw - a.yaw);
  return {{a.p + u * way, a.yaw + u * turn}, (1.0 / track.step) * way, turn / track.step};
}

// Looks for what is least between the neighbours of one look; `keep` says whether it is less now.
template <class Window, class Keep>
void narrow(const Window& window, std::size_t look, int more, const Keep& keep) noexcept {
  const auto inside = [&](std::size_t k) {
    return std::clamp(look_time(k), window.from, window.to);
  };
  double low = inside(look > 0 ? look - 1 : 0);
  double high = inside(std::min(look + 1, num_spans));
  double middle = inside(look);
  keep(middle);
  for (int i = 0; i < more && high - low > least_step; ++i) {
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

// Two lines, each through two points: where they cross.
struct Point {
  double time = 0.0;
  double score = 0.0;
};
struct Valley {
  Point left_far;
  Point left;
  Point right;
  Point right_far;

  // Where the lines on from both sides cross, between `left` and `right`; without a number:
  // nowhere.
  [[nodiscard]] Point bottom() const noexcept {
    const double falls = (left.score - left_far.score) / (left.time - left_far.time);
    const double rises = (right_far.score - right.score) / (right_far.time - right.time);
    const double time =
        (right.score - left.score + falls * left.time - rises * right.time) / (falls - rises);
    const bool inside = time > left.time && time < right.time;
    return {inside ? time : std::numeric_limits<double>::quiet_NaN(),
            left.score + falls * (time - left.time)};
  }
};

// No gap within a window is smaller.
template <class Window>
double least_of(const Window& window, const NearLooks& near) noexcept {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    least = std::min(least, near.least[k]);
  }
  return static_cast<double>(least);
}

class Pair {
 public:
  Pair(const AtlasEgo& ego, std::size_t actor, const Track& track, const Looks& looks) noexcept;

  /// The first group of spans in which they may touch; num_groups: in none.
  [[nodiscard]] std::size_t first_group() const noexcept { return first_group_; }
  /// They never come nearer at the mean, as far as is known.
  [[nodiscard]] double least() const noexcept { return std::min(least_, least_elsewhere_); }
  /// All but the clearance.
  [[nodiscard]] Meeting meet(double until) noexcept;
  /// After `meet`.
  [[nodiscard]] double clearance(double of_interest, double until) const noexcept;

 private:
  using ScoreRow = std::array<float, num_spans + 8>;
  struct Look {
    double time = 0.0;
    Gap gap;
    double size = 0.0;     // of the gap; exact where it decides on contact
    double closing = 0.0;  // along the gap, turning included [m/s]
  };
  struct Window {
    double from = 0.0;  // [s]
    double to = 0.0;
    std::size_t first = 0;  // groups of spans
    std::size_t last = 0;
    bool any = false;  // such groups

    [[nodiscard]] std::size_t begin() const noexcept { return first * spans_per_group; }
    [[nodiscard]] std::size_t end() const noexcept { return (last + 1) * spans_per_group; }
    [[nodiscard]] bool holds(std::size_t span) const noexcept {
      return look_time(span) <= to && look_time(span + 1) >= from;
    }
  };

  // Only of boxes do a few directions tell for sure.
  [[nodiscard]] bool either_is_round() const noexcept {
    return actor_->footprint.shape == Shape::ellipse ||
           ego_->scene().ego_footprint.shape == Shape::ellipse;
  }
  [[nodiscard]] double exact(double time, double size) const noexcept;
  [[nodiscard]] double gap_at(double time) const noexcept;
  [[nodiscard]] Look look(double time) const noexcept;
  [[nodiscard]] double last_look() const noexcept;
  [[nodiscard]] double sd_until(double time) const noexcept;
  template <class Matters>
  [[nodiscard]] Window window(double until, const Matters& matters) const noexcept;
  [[nodiscard]] std::optional<double> touch_within(double from, double to) const noexcept;
  [[nodiscard]] std::optional<double> first_touch(const Window& window,
                                                  const NearLooks& near) const noexcept;
  void find_likeliest(const Window& window, const NearLooks& near, Meeting& found) const noexcept;
  template <class Keep>
  bool walk_down(const ScoreRow& scores, const NearLooks& near, std::size_t likeliest,
                 const Keep& keep) const noexcept;
  [[nodiscard]] double touch_between(double apart, double high, double touching,
                                     double low) const noexcept;
  [[nodiscard]] Spread spread(double time, Vec2 n_W) const noexcept;
  [[nodiscard]] double score(const Look& now) const noexcept;
  [[nodiscard]] std::size_t nearest_look(const Window& window,
                                         const NearLooks& near) const noexcept;
  [[nodiscard]] double scores_at(const Window& window, const NearLooks& near,
                                 ScoreRow& scores) const noexcept;

  const AtlasEgo* ego_ = nullptr;
  const world::Actor* actor_ = nullptr;
  const Track* track_ = nullptr;
  const Looks* looks_ = nullptr;
  double start_ = 0.0;
  double first_ = 0.0;  // the actor is there from then on [s]
  double last_ = 0.0;   // and looked at until then [s]
  double reach_ = 0.0;  // of both bodies together from their origins [m]
  bool spreads_ = false;
  std::size_t first_group_ = num_groups;
  std::array<float, num_groups> group_gap_{};
  Window seen_;                       // looked over by `meet`
  std::size_t nearest_ = 0;           // look of it
  double least_ = endless;            // there
  double least_elsewhere_ = endless;  // outside
};

Pair::Pair(const AtlasEgo& ego, std::size_t actor, const Track& track, const Looks& looks) noexcept
    : ego_(&ego),
      actor_(&ego.scene().actors[actor]),
      track_(&track),
      looks_(&looks),
      start_(ego.scene().time),
      first_(std::max(0.0, looks.from)),
      last_(last_look()),
      reach_(ego.looks().reach + looks.reach + std::abs(ego.scene().ego_footprint.centre_x) +
             std::abs(actor_->footprint.centre_x)),
      spreads_(ego.scene().grip_sd > 0.0 || actor_->position_sd > 0.0 || actor_->velocity_sd > 0.0),
      group_gap_(group_gaps(ego.looks(), looks)) {
  const auto touch =
      std::find_if(group_gap_.begin(), group_gap_.end(), [](float gap) { return !(gap > 0.0F); });
  first_group_ = static_cast<std::size_t>(touch - group_gap_.begin());
}

// Of what is round, the distance where the gap decides on nothing.
double Pair::exact(double time, double size) const noexcept {
  if (size > 0.0 || !either_is_round()) {
    return size;
  }
  const double distance = separation(ego_->scene().ego_footprint, ego_->at(time).X_WB,
                                     actor_->footprint, pose_at(*track_, start_ + time))
                              .distance;
  return std::max(size, distance);
}

// Positive while they are apart: of boxes never more than the distance, of others exact.
double Pair::gap_at(double time) const noexcept {
  const Gap gap = gap_between(body_at(ego_->scene().ego_footprint, ego_->at(time).X_WB),
                              body_at(actor_->footprint, on_track(*track_, start_ + time).X_WA));
  return exact(time, gap.size);
}

Pair::Look Pair::look(double time) const noexcept {
  const Instant ego = ego_->at(time);
  const OnTrack other = on_track(*track_, start_ + time);
  Look now{.time = time};
  now.gap = gap_between(body_at(ego_->scene().ego_footprint, ego.X_WB),
                        body_at(actor_->footprint, other.X_WA));
  now.size = exact(time, now.gap.size);
  const double turning = reach_ * (std::abs(ego.yaw_rate) + std::abs(other.yaw_rate));
  now.closing = dot(now.gap.n, ego.v_W - other.v_W) + turning;
  return now;
}

double Pair::last_look() const noexcept {
  if (ego_->path().rests) {
    return looks_->goes ? looks_->end : std::max(ego_->path().end, looks_->end);
  }
  return looks_->goes ? std::min(ego_->last_look(), looks_->end) : ego_->last_look();
}

// At most so much do both places spread.
double Pair::sd_until(double time) const noexcept {
  return actor_->position_sd + actor_->velocity_sd * time + ego_->most_sway();
}

// The groups of spans from the first to the last in which they come as near as matters.
template <class Matters>
Pair::Window Pair::window(double until, const Matters& matters) const noexcept {
  Window window{.from = first_, .to = std::min(until, last_)};
  if (!(window.from <= window.to)) {
    return window;
  }
  const std::size_t begin = std::min(span_at(window.from), num_spans - 1) / spans_per_group;
  const std::size_t end = std::min(span_at(window.to), num_spans - 1) / spans_per_group;
  for (std::size_t g = begin; g <= end; ++g) {
    if (!(static_cast<double>(group_gap_[g]) > matters(look_time((g + 1) * spans_per_group)))) {
      window.first = window.any ? window.first : g;
      window.last = g;
      window.any = true;
    }
  }
  return window;
}

// Between a time apart and one where they touch, and the gaps there.
double Pair::touch_between(double apart, double high, double touching, double low) const noexcept {
  return last_positive(apart, high - near_touch, touching, low - near_touch, 1e-6, near_touch,
                       [&](double time) { return gap_at(time) - near_touch; });
}

std::optional<double> Pair::touch_within(double from, double to) const noexcept {
  Look before = look(from);
  if (before.size <= 0.0) {
    return from;
  }
  if (to - from < looks_end) {  // one span, or some
    const double size = gap_at(to);
    if (size <= 0.0) {
      return touch_between(from, before.size, to, size);
    }
  }
  while (before.time < to) {
    const double closing = before.closing + jump;
    const double safe =
        (std::sqrt(closing * closing + 2.0 * most_change * before.size) - closing) / most_change;
    const double next = before.time + std::max(safe, least_step);
    if (!(next < to)) {
      break;
    }
    const Look now = look(next);
    if (now.size <= 0.0) {
      return touch_between(before.time, before.size, next, now.size);
    }
    before = now;
  }
  return std::nullopt;
}

std::optional<double> Pair::first_touch(const Window& window,
                                        const NearLooks& near) const noexcept {
  for (std::size_t k = window.begin(); window.any && k < window.end(); ++k) {
    const double from = std::max(window.from, look_time(k));
    const double to = std::min(window.to, look_time(k + 1));
    if (near.least[k] <= 0.0F && from <= to) {
      if (const auto touch = touch_within(from, to)) {
        return touch;
      }
    }
  }
  return window.to > looks_end ? touch_within(std::max(window.from, looks_end), window.to)
                               : std::nullopt;
}

// The look of a window at which they are nearest.
std::size_t Pair::nearest_look(const Window& window, const NearLooks& near) const noexcept {
  std::size_t nearest = num_spans;
  float gap = std::numeric_limits<float>::infinity();
  for (std::size_t k = window.begin(); k <= window.end(); ++k) {
    const bool inside = window.holds(std::min(k, num_spans - 1)) || (k > 0 && window.holds(k - 1));
    if (inside && near.gap[k] < gap) {
      gap = near.gap[k];
      nearest = k;
    }
  }
  return nearest;
}

// Smallest distance at the mean of two that do not touch.
double Pair::clearance(double of_interest, double until) const noexcept {
  double best = of_interest;
  const auto look_near = [&](const Window& window, std::size_t look) {
    narrow(window, look, 6, [&](double time) {
      const double size = gap_at(time);
      const bool nearer = size < best;
      best = nearer ? size : best;
      return nearer;
    });
  };
  if (least_ < best) {
    look_near(seen_, nearest_);
  }
  if (least_elsewhere_ < best) {
    const Window all = window(until, [&](double /*time*/) { return best; });
    if (all.any) {
      NearLooks near;
      look_over(ego_->looks(), *looks_, all.first, all.last, near);
      if (least_of(all, near) < best) {
        look_near(all, nearest_look(all, near));
      }
    }
  }
  return std::max(0.0, best);
}

Spread Pair::spread(double time, Vec2 n_W) const noexcept {
  const double moved = actor_->velocity_sd * time;
  Spread spread{0.0, actor_->position_sd * actor_->position_sd + moved * moved};
  if (ego_->scene().grip_sd > 0.0) {
    const AtlasEgo::Sways sways = ego_->sways(time);
    const Spread grip = of_halves(dot(n_W, sways.less_W), dot(n_W, sways.more_W));
    // The ego farther along n_W leaves a smaller gap.
    spread.mean = -grip.mean;
    spread.variance += grip.variance;
  }
  return spread;
}

// How many standard deviations of the gap are between them.
double Pair::score(const Look& now) const noexcept {
  const Spread here = spread(now.time, now.gap.n);
  return (now.gap.size + here.mean) / std::sqrt(std::max(here.variance, least_sd * least_sd));
}

// How many standard deviations of the gap are between them at the looks of a window, and never
// less than the result in between.
double Pair::scores_at(const Window& window, const NearLooks& near,
                       ScoreRow& scores) const noexcept {
  const auto place_sd = static_cast<float>(actor_->position_sd);
  const auto speed_sd = static_cast<float>(actor_->velocity_sd);
  ScoreRow means;
  ScoreRow variances;
  const std::size_t begin = window.begin();
  const std::size_t end = window.end() + spans_per_group;
  for (std::size_t k = begin; k < end; ++k) {
    const float moved = speed_sd * look_times[k];
    means[k] = 0.0F;
    variances[k] = place_sd * place_sd + moved * moved;
  }
  if (ego_->scene().grip_sd > 0.0) {
    const AtlasEgo::SwayLooks& sway = ego_->sway_looks();
    constexpr float mean_share = 0.3989423F;  // 1 / sqrt(2 pi), as in of_halves
    for (std::size_t k = begin; k < end; ++k) {
      const float less = near.n_x[k] * sway.less_x[k] + near.n_y[k] * sway.less_y[k];
      const float more = near.n_x[k] * sway.more_x[k] + near.n_y[k] * sway.more_y[k];
      means[k] = -mean_share * (less + more);
      variances[k] += 0.5F * (less * less + more * more) - means[k] * means[k];
    }
  }
  constexpr auto least_variance = static_cast<float>(least_sd * least_sd);
  for (std::size_t k = begin; k < end; ++k) {
    variances[k] = 1.0F / std::sqrt(std::max(variances[k], least_variance));
    scores[k] = (near.gap[k] + means[k]) * variances[k];
  }
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = begin; k < window.end(); ++k) {
    const float lowest = near.least[k] + std::min(means[k], means[k + 1]);
    const float per_sd = lowest > 0.0F ? std::min(variances[k], variances[k + 1])
                                       : std::max(variances[k], variances[k + 1]);
    least = std::min(least, lowest * per_sd);
  }
  const auto from = static_cast<float>(window.from);
  const auto to = static_cast<float>(window.to);
  for (std::size_t k = begin; k <= window.end(); ++k) {
    const bool inside = look_times[k] >= from && look_times[k] <= to && near.gap[k] > nowhere;
    scores[k] = inside ? scores[k] : std::numeric_limits<float>::infinity();
  }
  return static_cast<double>(least);
}

// The score mostly falls along one axis of the boxes and rises along another: looks where the two
// lines cross, and again. False: there is no valley between looks.
template <class Keep>
bool Pair::walk_down(const ScoreRow& scores, const NearLooks& near, std::size_t likeliest,
                     const Keep& keep) const noexcept {
  const auto valley_right_of = [&](std::size_t k) {
    const auto point = [&](std::size_t i) {
      return Point{look_time(i), static_cast<double>(scores[i])};
    };
    return Valley{point(k - 1), point(k), point(k + 1), point(k + 2)};
  };
  if (likeliest < 2 || likeliest + 2 > num_spans) {
    return false;
  }
  Valley valley = valley_right_of(likeliest);
  std::size_t left = likeliest;
  const Valley before = valley_right_of(likeliest - 1);
  const Point bottom_before = before.bottom();
  const Point bottom_after = valley.bottom();
  if (std::isfinite(bottom_before.time) &&
      !(std::isfinite(bottom_after.time) && bottom_after.score <= bottom_before.score)) {
    valley = before;
    left = likeliest - 1;
  }
  const Vec2 left_n{static_cast<double>(near.n_x[left]), static_cast<double>(near.n_y[left])};
  const Vec2 right_n{static_cast<double>(near.n_x[left + 1]),
                     static_cast<double>(near.n_y[left + 1])};
  for (int i = 0; i < 3; ++i) {
    const Point bottom = valley.bottom();
    if (!std::isfinite(bottom.time) || !std::isfinite(bottom.score)) {
      return i > 0;
    }
    const Look now = look(bottom.time);
    const Point here{bottom.time, keep(now)};
    if (here.score - bottom.score < 0.02) {
      break;
    }
    const bool falls = dot(now.gap.n, left_n) > dot(now.gap.n, right_n);
    (falls ? valley.left_far : valley.right_far) = falls ? valley.left : valley.right;
    (falls ? valley.left : valley.right) = here;
  }
  return true;
}

// When contact is likeliest, and how likely.
void Pair::find_likeliest(const Window& window, const NearLooks& near,
                          Meeting& found) const noexcept {
  if (!window.any) {
    return;
  }
  ScoreRow scores;
  const double least = scores_at(window, near, scores);
  if (least > sure_sd) {
    return;
  }
  double best = endless;
  const auto keep_look = [&](const Look& now) {
    const double its = score(now);
    if (its < best) {
      best = its;
      found.nearest = now.time;
      found.gap = now.gap.size;
      found.n_W = now.gap.n;
    }
    return its;
  };
  const auto keep = [&](double time) {
    const double before = best;
    return keep_look(look(time)) < before;
  };
  const auto likeliest = static_cast<std::size_t>(
      std::min_element(scores.begin() + window.begin(), scores.begin() + window.end() + 1) -
      scores.begin());
  if (static_cast<double>(scores[likeliest]) < -sure_sd - 1.0) {
    best = static_cast<double>(scores[likeliest]);
    found.nearest = look_time(likeliest);
  } else if (!walk_down(scores, near, likeliest, keep_look)) {
    narrow(window, likeliest, 5, keep);
  } else if (static_cast<double>(scores[likeliest]) < best) {
    keep(look_time(likeliest));
  }
  if (found.contact && best > 0.0) {
    keep(*found.contact);
  }
  found.probability = normal_below(-best);
}

Meeting Pair::meet(double until) noexcept {
  seen_ = window(until, [&](double time) { return spreads_ ? sure_sd * sd_until(time) : 0.0; });
  Meeting found;
  NearLooks near;
  if (seen_.any) {
    look_over(ego_->looks(), *looks_, seen_.first, seen_.last, near);
    least_ = least_of(seen_, near);
  }
  for (std::size_t g = 0; g < num_groups; ++g) {
    const bool seen = seen_.any && g >= seen_.first && g <= seen_.last;
    const auto gap = static_cast<double>(group_gap_[g]);
    least_elsewhere_ = seen ? least_elsewhere_ : std::min(least_elsewhere_, gap);
  }
  if (!(least_ > 0.0) || seen_.to > looks_end) {
    found.contact = first_touch(seen_, near);
  }
  if (!found.contact && seen_.any) {
    nearest_ = nearest_look(seen_, near);
  }
  if (spreads_) {
    find_likeliest(seen_, near, found);
  } else {
    found.probability = found.contact ? 1.0 : 0.0;
  }
  return found;
}

}  // namespace

Meetings meetings(const AtlasEgo& ego, std::span<const Track> tracks, std::span<const Looks> looks,
                  double of_interest, double until) noexcept {
  Meetings all;
  std::array<std::optional<Pair>, world::max_actors> pairs;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    pairs[i].emplace(ego, i, tracks[i], looks[i]);
    all.push_back({});
  }
  bool touches = false;
  for (std::size_t group = 0; group <= num_groups; ++group) {  // who may be struck first, first
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (pairs[i]->first_group() != group) {
        continue;
      }
      all[i] = pairs[i]->meet(until);
      touches = touches || all[i].contact;
      if (all[i].contact &&
          all[i].probability * ego.scene().actors[i].existence > 1.0 - negligible) {
        until = std::min(until, *all[i].contact);
      }
    }
  }
  double clearance = touches ? 0.0 : of_interest;
  while (clearance > 0.0) {
    const auto nearer = [](const std::optional<Pair>& a, const std::optional<Pair>& b) {
      return a && (!b || a->least() < b->least());
    };
    std::optional<Pair>& nearest =
        *std::min_element(pairs.begin(), pairs.begin() + tracks.size(), nearer);
    if (tracks.empty() || !nearest || !(nearest->least() < clearance)) {
      break;
    }
    clearance = nearest->clearance(clearance, until);
    nearest.reset();
  }
  for (Meeting& met : all) {
    met.clearance = clearance;
  }
  return all;
}

}  // namespace saca::outcome
