#include "saca/lab/recordings/radar_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/recordings/series.h"

namespace saca::recordings {
namespace {

const StaticVector<RadarTarget, radar_columns>& seen_in(const HundredCarRow& row, Radar radar) {
  return radar == Radar::front ? row.front : row.rear;
}

double aside(const RadarTarget& target) {
  return std::abs(target.range * std::sin(target.azimuth));
}

/// The nearest target near the axis.
std::optional<RadarTarget> nearest(const HundredCarRow& row, Radar radar) {
  std::optional<RadarTarget> found;
  for (const RadarTarget& target : seen_in(row, radar)) {
    if (aside(target) <= near_axis && target.range >= smallest_range &&
        (!found || target.range < found->range)) {
      found = target;
    }
  }
  return found;
}

/// The target that `last`, seen `elapsed` seconds ago (< 0: to be seen later), is now: among those
/// that it could have become, the one with its id, or else the one nearest to where it should be.
std::optional<RadarTarget> successor(const HundredCarRow& row, Radar radar, const RadarTarget& last,
                                     double elapsed) {
  // Gates: 1 m and 3 m/s of noise, 2 m/s and 5 m/s^2 of what it may have done meanwhile.
  const double expected = last.range + last.rate * elapsed;
  const double age = std::abs(elapsed);
  std::optional<RadarTarget> best;
  double best_distance = 0.0;
  for (const RadarTarget& target : seen_in(row, radar)) {
    const double distance = std::abs(target.range - expected);
    constexpr double widest = 2.0;  // from the axis [m]: beyond, it is in another lane
    if (distance > 1.0 + 2.0 * age || std::abs(target.rate - last.rate) > 3.0 + 5.0 * age ||
        aside(target) > widest) {
      continue;
    }
    if (target.id == last.id) {
      return target;
    }
    if (!best || distance < best_distance) {
      best = target;
      best_distance = distance;
    }
  }
  return best;
}

/// What was seen of one thing in each row.
using Seen = std::vector<std::optional<RadarTarget>>;

void follow(const std::vector<HundredCarRow>& rows, Radar radar, std::size_t seed, bool forward,
            Seen& sightings) {
  RadarTarget last = sightings[seed].value();
  std::size_t last_row = seed;
  const std::size_t num_ahead = forward ? rows.size() - 1 - seed : seed;
  for (std::size_t k = 1; k <= num_ahead; ++k) {
    const std::size_t row = forward ? seed + k : seed - k;
    const double elapsed =
        hundred_car_step * (static_cast<double>(row) - static_cast<double>(last_row));
    if (std::abs(elapsed) > longest_gap + 0.5 * hundred_car_step) {
      return;
    }
    if (const std::optional<RadarTarget> next = successor(rows[row], radar, last, elapsed)) {
      sightings[row] = next;
      last = *next;
      last_row = row;
    }
  }
}

Seen followed(const std::vector<HundredCarRow>& rows, Radar radar, std::size_t seed,
              const RadarTarget& target) {
  Seen sightings(rows.size());
  sightings[seed] = target;
  follow(rows, radar, seed, true, sightings);
  follow(rows, radar, seed, false, sightings);
  return sightings;
}

/// Makes the other columns missing where the range is.
void match_missing(const std::vector<double>& range, std::vector<double>& column) {
  for (std::size_t k = 0; k < range.size(); ++k) {
    if (std::isnan(range[k])) {
      column[k] = missing;
    }
  }
}

RadarTrack track_of(const Seen& sightings) {
  RadarTrack track;
  const auto first = std::find_if(sightings.begin(), sightings.end(),
                                  [](const auto& sighting) { return sighting.has_value(); });
  const auto last = std::find_if(sightings.rbegin(), sightings.rend(),
                                 [](const auto& sighting) { return sighting.has_value(); });
  expects(first != sightings.end(), "something was seen");
  track.first_row = static_cast<std::size_t>(first - sightings.begin());
  track.last_row = static_cast<std::size_t>(last.base() - sightings.begin()) - 1;
  for (std::size_t row = track.first_row; row <= track.last_row; ++row) {
    const auto& sighting = sightings[row];
    track.range.push_back(sighting ? sighting->range : missing);
    track.rate.push_back(sighting ? sighting->rate : missing);
    track.azimuth.push_back(sighting ? sighting->azimuth : missing);
    track.ids.push_back(sighting ? sighting->id : 0);
    track.sightings.push_back(sighting ? Sighting::kept : Sighting::none);
  }
  (void)remove_outliers(track.range, track.rate, hundred_car_step, 3, outlier_bound);
  match_missing(track.range, track.rate);
  match_missing(track.range, track.azimuth);
  for (std::size_t k = 0; k < track.range.size(); ++k) {
    if (track.sightings[k] == Sighting::kept && std::isnan(track.range[k])) {
      track.sightings[k] = Sighting::outlier;
    }
  }
  track.range = filled(track.range).values;
  track.rate = filled(track.rate).values;
  track.azimuth = filled(track.azimuth).values;
  return track;
}

}  // namespace

double rate_disagreement(const RadarTrack& track, std::size_t first, std::size_t last) {
  expects(first <= last && last < track.range.size(), "first <= last < number of entries");
  const std::vector<double> slopes = line_fit(track.range, hundred_car_step, 5).slopes;
  const std::vector<double> rates = line_fit(track.rate, hundred_car_step, 5).values;
  double sum = 0.0;
  for (std::size_t k = first; k <= last; ++k) {
    sum += std::pow(slopes[k] - rates[k], 2);
  }
  return std::sqrt(sum / static_cast<double>(last - first + 1));
}

std::optional<RadarTrack> lead_track(const std::vector<HundredCarRow>& rows, std::size_t first,
                                     std::size_t last) {
  expects(first <= last && last < rows.size(), "first <= last < number of rows");
  std::optional<std::size_t> seed;
  RadarTarget target;
  double least = 0.0;
  for (std::size_t row = first; row <= last; ++row) {
    const std::optional<RadarTarget> found = nearest(rows[row], Radar::front);
    if (!found || found->rate > -1.0) {
      continue;
    }
    const double time = found->range / -found->rate;
    if (!seed || time < least) {
      seed = row;
      target = *found;
      least = time;
    }
  }
  if (!seed) {
    return std::nullopt;
  }
  return track_of(followed(rows, Radar::front, *seed, target));
}

std::optional<RadarTrack> follower_track(const std::vector<HundredCarRow>& rows, std::size_t first,
                                         std::size_t last, std::size_t conflict,
                                         std::size_t fewest) {
  expects(first <= conflict && conflict <= last && last < rows.size(),
          "first <= conflict <= last < number of rows");
  std::optional<Seen> best;
  std::pair<double, double> best_place;  // how long from the conflict, how far behind
  Seen tried(rows.size());
  for (std::size_t row = first; row <= last; ++row) {
    const std::optional<RadarTarget> found = nearest(rows[row], Radar::rear);
    if (!found || (tried[row] && tried[row]->id == found->id)) {
      continue;
    }
    Seen seen = followed(rows, Radar::rear, row, *found);
    tried = seen;
    std::size_t count = 0;
    std::pair<double, double> place{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t k = first; k <= last; ++k) {
      if (seen[k]) {
        ++count;
        const double away = std::abs(static_cast<double>(k) - static_cast<double>(conflict));
        place = std::min(place, {away, seen[k]->range});
      }
    }
    if (count > 0 && count >= fewest && (!best || place < best_place)) {
      best = std::move(seen);
      best_place = place;
    }
  }
  if (!best) {
    return std::nullopt;
  }
  return track_of(*best);
}

}  // namespace saca::recordings
