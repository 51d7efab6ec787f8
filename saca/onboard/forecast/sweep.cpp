#include "saca/onboard/forecast/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>

#include "saca/onboard/collision/false_position.h"
#include "saca/onboard/forecast/likeliest.h"
#include "saca/onboard/forecast/narrow_phase.h"

namespace saca::forecast {
namespace {

using world::Track;

constexpr double least_step = 0.01;   // [s]
constexpr double most_change = 20.0;  // of the two velocities against each other [m/s^2]
constexpr double jump = 1.0;          // that a walker's track may make at once [m/s]
// Apart by so little two bodies touch: less, and where they touch is slow to find [m].
constexpr double near_touch = 5e-6;
constexpr double endless = std::numeric_limits<double>::infinity();

double group_time(std::size_t group) noexcept {
  return sample_time(group * spans_per_group);
}

// No gap within a window is smaller.
double least_of(const Window& window, const PairSamples& near) noexcept {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = window.begin(); k < window.end(); ++k) {
    least = std::min(least, near.least[k]);
  }
  return static_cast<double>(least);
}

// The sample of a window at which they are nearest: at either end of a span that lies in it.
std::size_t nearest_sample(const Window& window, const PairSamples& near) noexcept {
  std::size_t begin = window.begin();
  std::size_t end = window.end();
  while (begin < end && !window.holds(begin)) {
    ++begin;
  }
  while (begin < end && !window.holds(end - 1)) {
    --end;
  }
  std::size_t nearest = num_spans;
  float gap = std::numeric_limits<float>::infinity();
  for (std::size_t k = begin; k <= end && begin < end; ++k) {
    if (near.gap[k] < gap) {
      gap = near.gap[k];
      nearest = k;
    }
  }
  return nearest;
}

// The ego and one actor all along.
class Pair {
 public:
  Pair(const AtlasEgo& ego, std::size_t actor, const Track& track, const PoseSamples& samples,
       const world::SpreadOverTime* spread) noexcept;

  /// The first group of spans in which they may touch; num_groups: in none.
  [[nodiscard]] std::size_t first_group() const noexcept { return first_group_; }
  /// They never come nearer at the mean, as far as is known.
  [[nodiscard]] double least() const noexcept { return std::min(least_, least_elsewhere_); }
  /// All but the clearance.
  [[nodiscard]] ContactForecast meet(double until) noexcept;
  /// Lowers the clearance that `nearest` has, and says when, where these two come nearer until
  /// then. After `meet`.
  void approach(double until, ContactForecast& nearest) const noexcept;

 private:
  [[nodiscard]] double last_sample() const noexcept;
  template <class Matters>
  [[nodiscard]] Window window(double until, const Matters& matters) const noexcept;
  [[nodiscard]] std::optional<double> touch_within(double from, double to) const noexcept;
  [[nodiscard]] std::optional<double> first_touch(const Window& window,
                                                  const PairSamples& near) const noexcept;
  [[nodiscard]] double touch_between(double apart, double high, double touching,
                                     double low) const noexcept;

  NarrowPhase both_;
  double first_ = 0.0;           // the actor is there from then on [s]
  double last_ = 0.0;            // and looked at until then [s]
  std::size_t begin_group_ = 0;  // in which both are there
  std::size_t end_group_ = 0;
  std::size_t first_group_ = num_groups;
  std::array<float, num_groups> group_gap_{};
  Window seen_;                       // compared by `meet`
  std::size_t nearest_ = 0;           // sample of it
  double least_ = endless;            // there
  double least_elsewhere_ = endless;  // outside
};

Pair::Pair(const AtlasEgo& ego, std::size_t actor, const Track& track, const PoseSamples& samples,
           const world::SpreadOverTime* spread) noexcept
    : both_(ego, actor, track, samples, spread),
      first_(std::max(0.0, samples.from)),
      last_(last_sample()),
      group_gap_(group_gaps(ego.samples(), samples)) {
  const auto group_of = [](double time) {
    return std::min(span_at(time), num_spans - 1) / spans_per_group;
  };
  begin_group_ = group_of(first_);
  end_group_ = first_ <= last_ ? group_of(last_) + 1 : begin_group_;
  for (first_group_ = begin_group_; first_group_ < end_group_; ++first_group_) {
    if (!(group_gap_[first_group_] > 0.0F)) {
      return;
    }
  }
  first_group_ = num_groups;
}

double Pair::last_sample() const noexcept {
  const AtlasEgo& ego = both_.ego();
  const PoseSamples& other = both_.samples();
  if (ego.path().rests) {
    return other.goes ? other.end : std::max(ego.path().end, other.end);
  }
  return other.goes ? std::min(ego.last_sample(), other.end) : ego.last_sample();
}

// The groups of spans from the first to the last in which they come as near as matters.
template <class Matters>
Window Pair::window(double until, const Matters& matters) const noexcept {
  Window window{.from = first_, .to = std::min(until, last_)};
  if (!(window.from <= window.to)) {
    return window;
  }
  for (std::size_t g = begin_group_; g < end_group_ && group_time(g) <= window.to; ++g) {
    if (!(static_cast<double>(group_gap_[g]) > matters(group_time(g + 1)))) {
      window.first = window.any ? window.first : g;
      window.last = g;
      window.any = true;
    }
  }
  return window;
}

// Between a time apart and one where they touch, and the gaps there.
double Pair::touch_between(double apart, double high, double touching, double low) const noexcept {
  return collision::last_positive({apart, high - near_touch, touching, low - near_touch}, 1e-6,
                                  near_touch,
                                  [&](double time) { return both_.gap_at(time) - near_touch; });
}

std::optional<double> Pair::touch_within(double from, double to) const noexcept {
  NarrowPhase::PairState before = both_.state_at(from);
  if (before.size <= 0.0) {
    return from;
  }
  if (to - from < samples_end) {  // one span, or some
    const double size = both_.gap_at(to);
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
    const NarrowPhase::PairState now = both_.state_at(next);
    if (now.size <= 0.0) {
      return touch_between(before.time, before.size, next, now.size);
    }
    before = now;
  }
  return std::nullopt;
}

std::optional<double> Pair::first_touch(const Window& window,
                                        const PairSamples& near) const noexcept {
  for (std::size_t k = window.begin(); window.any && k < window.end(); ++k) {
    const double from = std::max(window.from, sample_time(k));
    const double to = std::min(window.to, sample_time(k + 1));
    if (near.least[k] <= 0.0F && from <= to) {
      if (const auto touch = touch_within(from, to)) {
        return touch;
      }
    }
  }
  return window.to > samples_end ? touch_within(std::max(window.from, samples_end), window.to)
                                 : std::nullopt;
}

// At the mean, of two that do not touch.
void Pair::approach(double until, ContactForecast& nearest) const noexcept {
  double& best = nearest.clearance;
  const auto look_near = [&](const Window& window, std::size_t sample) {
    narrow(window, sample, 6, [&](double time) {
      const double distance = both_.distance_at(time);
      if (!(distance < best)) {
        return false;
      }
      best = std::max(0.0, distance);
      nearest.nearest_at = time;
      return true;
    });
  };
  if (least_ < best) {
    look_near(seen_, nearest_);
  }
  if (least_elsewhere_ < best) {
    const Window all = window(until, [&](double /*time*/) { return best; });
    if (all.any) {
      PairSamples near;
      compare_samples(both_.ego().samples(), both_.samples(), all.first, all.last, near);
      if (least_of(all, near) < best) {
        look_near(all, nearest_sample(all, near));
      }
    }
  }
}

ContactForecast Pair::meet(double until) noexcept {
  seen_ = window(
      until, [&](double time) { return both_.spreads() ? sure_sd * both_.sd_until(time) : 0.0; });
  ContactForecast found;
  PairSamples near;
  if (seen_.any) {
    compare_samples(both_.ego().samples(), both_.samples(), seen_.first, seen_.last, near);
    least_ = least_of(seen_, near);
  }
  for (std::size_t g = begin_group_; g < end_group_; ++g) {
    const bool seen = seen_.any && g >= seen_.first && g <= seen_.last;
    const auto gap = static_cast<double>(group_gap_[g]);
    least_elsewhere_ = seen ? least_elsewhere_ : std::min(least_elsewhere_, gap);
  }
  if (!(least_ > 0.0) || seen_.to > samples_end) {
    found.contact = first_touch(seen_, near);
  }
  if (!found.contact && seen_.any) {
    nearest_ = nearest_sample(seen_, near);
  }
  if (both_.spreads()) {
    find_likeliest(both_, seen_, near, found);
  } else {
    found.probability = found.contact ? 1.0 : 0.0;
  }
  return found;
}

// Room for all pairs; only those that there are get made.
class Pairs {
 public:
  Pairs() noexcept {}  // NOLINT(*-member-init): that is what it is for

  void add(const AtlasEgo& ego, std::size_t actor, const Track& track, const PoseSamples& samples,
           const world::SpreadOverTime* spread) noexcept {
    std::construct_at(&pairs_[actor], ego, actor, track, samples, spread);
  }
  [[nodiscard]] Pair& operator[](std::size_t actor) noexcept { return pairs_[actor]; }

 private:
  static_assert(std::is_trivially_destructible_v<Pair>);
  union {
    std::array<Pair, world::max_actors> pairs_;
  };
};

// Gives all the smallest distance that any of them has at the mean, and says of whose it is when.
void find_clearance(Pairs& pairs, double of_interest, double until,
                    ContactForecasts& all) noexcept {
  ContactForecast least{.clearance = of_interest};
  std::optional<std::size_t> whose;
  std::array<bool, world::max_actors> done{};
  while (least.clearance > 0.0) {
    std::size_t nearest = all.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!done[i] && (nearest == all.size() || pairs[i].least() < pairs[nearest].least())) {
        nearest = i;
      }
    }
    if (nearest == all.size() || !(pairs[nearest].least() < least.clearance)) {
      break;
    }
    const double before = least.clearance;
    pairs[nearest].approach(until, least);
    whose = least.clearance < before ? nearest : whose;
    done[nearest] = true;
  }
  for (ContactForecast& met : all) {
    met.clearance = least.clearance;
  }
  if (whose) {
    all[*whose].nearest_at = least.nearest_at;
  }
}

}  // namespace

ContactForecasts meetings(const AtlasEgo& ego, std::span<const Track> tracks,
                          std::span<const PoseSamples> samples,
                          std::span<const world::SpreadOverTime> spreads, double of_interest,
                          double until) noexcept {
  ContactForecasts all;
  Pairs pairs;
  std::array<std::size_t, world::max_actors> order;  // who may be struck first, first
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    pairs.add(ego, i, tracks[i], samples[i], spreads.empty() ? nullptr : &spreads[i]);
    all.push_back({});
    std::size_t place = i;
    for (; place > 0 && pairs[order[place - 1]].first_group() > pairs[i].first_group(); --place) {
      order[place] = order[place - 1];
    }
    order[place] = i;
  }
  bool touches = false;
  for (std::size_t rank = 0; rank < tracks.size(); ++rank) {
    const std::size_t i = order[rank];
    all[i] = pairs[i].meet(until);
    touches = touches || all[i].contact;
    if (all[i].contact && all[i].probability * ego.scene().actors[i].existence > 1.0 - negligible) {
      until = std::min(until, *all[i].contact);
    }
  }
  if (!touches) {
    find_clearance(pairs, of_interest, until, all);
  }
  return all;
}

}  // namespace saca::forecast
