#include "saca/lab/importers/smooth_track.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/recordings/series.h"

namespace saca::importers {
namespace {

constexpr double fit_time = 0.7;       // half a window of positions [s]
constexpr double line_time = 0.5;      // half a window of heading and speed [s]
constexpr double jump = 1.5;           // [m]: no noise of a camera
constexpr double least_speed = 1.5;    // [m/s] at which the motion tells the heading
constexpr double noise_weight = 0.04;  // [s^2]: 0.05 m and 0.25 m/s, measured on NGSIM US-101

std::size_t steps_in(double seconds, double step) {
  return static_cast<std::size_t>(std::max(1L, std::lround(seconds / step)));
}

/// A recording as columns at equal steps; what is missing is NaN.
struct Columns {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> vx;
  std::vector<double> vy;
  std::vector<double> heading;
};

Columns columns_of(const scenario::Recording& raw, double step) {
  const double span = raw.back().time - raw.front().time;
  const std::size_t size = static_cast<std::size_t>(std::lround(span / step)) + 1;
  const std::vector<double> none(size, recordings::missing);
  Columns columns{none, none, none, none, none};
  for (const scenario::Sample& sample : raw) {
    const auto k = static_cast<std::size_t>(std::lround((sample.time - raw.front().time) / step));
    const Vec2 v_W = rotated({sample.speed, 0.0}, sample.X_WA.yaw);
    columns.x[k] = sample.X_WA.p.x;
    columns.y[k] = sample.X_WA.p.y;
    columns.vx[k] = v_W.x;
    columns.vy[k] = v_W.y;
    columns.heading[k] = sample.X_WA.yaw;
  }
  return columns;
}

/// Mean direction of those that are not missing.
double mean_heading(const std::vector<double>& headings) {
  Vec2 sum;
  for (const double heading : headings) {
    if (!std::isnan(heading)) {
      sum = sum + rotated({1.0, 0.0}, heading);
    }
  }
  return std::atan2(sum.y, sum.x);
}

/// Unwrapped headings of the motion, with the recorded ones telling forward from backward.
std::vector<double> headings_of(const recordings::Fit& x, const recordings::Fit& y,
                                const std::vector<double>& recorded) {
  std::vector<double> headings(recorded.size(), recordings::missing);
  double before = mean_heading(recorded);
  const double rest = before;
  bool any = false;
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    const Vec2 v_W{x.slopes[k], y.slopes[k]};
    if (norm(v_W) < least_speed || std::isnan(recorded[k])) {
      continue;
    }
    const bool reverses = rotated(v_W, -recorded[k]).x < 0.0;
    const double direction = std::atan2(v_W.y, v_W.x) + (reverses ? std::numbers::pi : 0.0);
    before += wrap_angle(direction - before);
    headings[k] = before;
    any = true;
  }
  return any ? recordings::filled(headings).values : std::vector<double>(recorded.size(), rest);
}

/// Throws away positions that jump, in both directions at once.
std::size_t remove_jumps(Columns& columns, double step) {
  const std::size_t half = steps_in(line_time, step);
  // Speeds at a gap do not matter: those positions are missing too.
  (void)recordings::remove_outliers(columns.x, recordings::filled(columns.vx).values, step, half,
                                    jump);
  (void)recordings::remove_outliers(columns.y, recordings::filled(columns.vy).values, step, half,
                                    jump);
  std::size_t num_removed = 0;
  for (std::size_t k = 0; k < columns.x.size(); ++k) {
    if ((std::isnan(columns.x[k]) || std::isnan(columns.y[k])) && !std::isnan(columns.vx[k])) {
      columns.x[k] = columns.y[k] = recordings::missing;
      ++num_removed;
    }
  }
  return num_removed;
}

double largest_length(const std::vector<double>& x, const std::vector<double>& y) {
  double largest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    largest = std::max(largest, std::hypot(x[k], y[k]));
  }
  return largest;
}

/// How far the fit lies from the positions.
void measure_shift(SmoothTrack& track, const Columns& columns) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < columns.x.size(); ++k) {
    if (!std::isnan(columns.x[k])) {
      const double shift = norm(track.samples[k].X_WA.p - Vec2{columns.x[k], columns.y[k]});
      track.largest_shift = std::max(track.largest_shift, shift);
      sum += shift * shift;
      ++count;
    }
  }
  track.rms_shift = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace

SmoothTrack smooth_track(const scenario::Recording& raw, double step) {
  expects(raw.size() >= fewest_samples, "raw.size() >= fewest_samples");
  expects(step > 0.0, "step > 0");
  Columns columns = columns_of(raw, step);
  SmoothTrack track;
  track.num_filled = columns.x.size() - raw.size();
  const Columns before = columns;
  track.num_outliers = remove_jumps(columns, step);
  if (2 * track.num_outliers > raw.size()) {
    columns = before;  // speeds that do not belong to the positions tell no jumps
    track.num_outliers = 0;
  }

  const std::size_t half = steps_in(fit_time, step);
  const recordings::Fit x =
      recordings::parabola_fit(recordings::filled(columns.x).values,
                               recordings::filled(columns.vx).values, step, half, noise_weight);
  const recordings::Fit y =
      recordings::parabola_fit(recordings::filled(columns.y).values,
                               recordings::filled(columns.vy).values, step, half, noise_weight);
  const std::size_t line = steps_in(line_time, step);
  const recordings::Fit heading =
      recordings::line_fit(headings_of(x, y, columns.heading), step, line);
  std::vector<double> along;
  for (std::size_t k = 0; k < columns.x.size(); ++k) {
    along.push_back(rotated({x.slopes[k], y.slopes[k]}, -heading.values[k]).x);
  }
  const std::vector<double> speed = recordings::line_fit(along, step, line).values;
  for (std::size_t k = 0; k < columns.x.size(); ++k) {
    track.samples.push_back({raw.front().time + static_cast<double>(k) * step,
                             {{x.values[k], y.values[k]}, wrap_angle(heading.values[k])},
                             std::max(0.0, speed[k]),
                             heading.slopes[k]});
  }
  measure_shift(track, columns);
  const std::size_t short_line = steps_in(0.2, step);
  track.hardest = largest_length(recordings::line_fit(x.slopes, step, short_line).slopes,
                                 recordings::line_fit(y.slopes, step, short_line).slopes);
  return track;
}

}  // namespace saca::importers
