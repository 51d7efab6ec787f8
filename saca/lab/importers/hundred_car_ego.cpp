#include "saca/lab/importers/hundred_car_ego.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/recordings/series.h"

namespace saca::importers {
namespace {

using Rows = std::vector<recordings::HundredCarRow>;

constexpr double row_step = recordings::hundred_car_step;
constexpr std::size_t settling = 5;      // rows: half a second
constexpr std::size_t longest_hold = 8;  // rows between two values of the slowest speed sensor
constexpr std::size_t longest_speed_gap = 15;  // rows

/// Longest stretch of NaN.
std::size_t longest_missing(const std::vector<double>& values) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const double value : values) {
    run = std::isnan(value) ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

/// Yaw rates while the car surely stands: half a second after it came to rest, and half a second
/// before it starts, since its speed is held.
std::vector<double> standing_yaw_rates(const Rows& rows) {
  constexpr double at_rest = 0.1;              // [m/s]
  constexpr std::size_t least = 5 * settling;  // rows
  constexpr double most = 0.05;                // [rad/s]: more is a jolt, or the car turns
  std::vector<double> standing;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].speed < at_rest) {
      ++end;
    }
    if (end - first >= least) {
      for (std::size_t row = first + settling; row < end - settling; ++row) {
        if (std::abs(rows[row].yaw_rate) < most) {
          standing.push_back(rows[row].yaw_rate);
        }
      }
    }
    first = std::max(end, first + 1);
  }
  return standing;
}

std::vector<double> moving_yaw_rates(const Rows& rows) {
  constexpr double moving = 5.0;  // [m/s]
  std::vector<double> found;
  for (const recordings::HundredCarRow& row : rows) {
    if (row.speed > moving && std::isfinite(row.yaw_rate)) {
      found.push_back(row.yaw_rate);
    }
  }
  return found;
}

/// The mean of both middle values of an even number, so that it is mirror-symmetric.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t size = values.size();
  return 0.5 * (values[(size - 1) / 2] + values[size / 2]);
}

/// The motion in all of the rows, `path` without its lane.
std::optional<EgoMotion> treated(const Rows& rows, const RowRange& all) {
  std::vector<double> speed;
  std::vector<double> yaw_rate;
  for (std::size_t row = all.first; row <= all.last; ++row) {
    speed.push_back(rows[row].speed);
    yaw_rate.push_back(rows[row].yaw_rate);
  }
  if (longest_missing(speed) > longest_speed_gap || longest_missing(yaw_rate) > longest_speed_gap ||
      speed.size() <= longest_speed_gap) {
    return std::nullopt;
  }
  EgoMotion ego;
  const std::vector<double> updates =
      recordings::filled(recordings::without_holds(recordings::filled(speed).values, longest_hold))
          .values;
  ego.speed = recordings::line_fit(updates, row_step, settling).values;
  for (double& v : ego.speed) {
    v = std::max(0.0, v);
  }
  constexpr double impossible =
      0.35;  // from the median of its neighbours [rad/s]: a jolt, not a turn
  (void)recordings::remove_outliers(yaw_rate, std::vector<double>(yaw_rate.size(), 0.0), row_step,
                                    2, impossible);
  if (longest_missing(yaw_rate) == yaw_rate.size()) {
    return std::nullopt;
  }
  ego.yaw_rate = recordings::filled(yaw_rate).values;
  return ego;
}

/// Forgets the first rows.
void forget(std::vector<double>& values, std::size_t num_rows) {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(num_rows));
}

}  // namespace

GyroBelief gyro_belief(const Rows& rows, bool curved) {
  constexpr std::size_t fewest = 10;
  const std::vector<double> standing = standing_yaw_rates(rows);
  if (standing.size() >= fewest) {
    const double sum = std::accumulate(standing.begin(), standing.end(), 0.0);
    return {sum / static_cast<double>(standing.size()), from_degrees(0.1)};
  }
  const std::vector<double> moving = moving_yaw_rates(rows);
  if (!curved && moving.size() >= fewest) {
    const double middle = median(moving);
    if (std::abs(middle) < from_degrees(1.5)) {
      return {middle, from_degrees(0.3)};
    }
  }
  return {0.0, from_degrees(0.5)};
}

std::optional<EgoMotion> ego_motion(const Rows& rows, const RowRange& kept, const RowRange& window,
                                    bool curved) {
  expects(kept.first <= kept.last && window.first <= window.last, "first <= last");
  expects(kept.first <= window.first && kept.last <= window.last && window.last < rows.size(),
          "the lane is kept from the scenario's first row or before, and within its rows");
  const std::size_t first = kept.first;
  std::optional<EgoMotion> made = treated(rows, {first, window.last});
  if (!made) {
    return std::nullopt;
  }
  EgoMotion& ego = *made;
  const GyroBelief gyro = gyro_belief(rows, curved);
  const double curvature_sd = curved ? 1.0 / 200.0 : 1.0 / 2000.0;
  ego.path = scenario::ego_path(ego.speed, ego.yaw_rate, row_step,
                                {.num_keeping = kept.size(),
                                 .bias = gyro.bias,
                                 .bias_sd = gyro.sd,
                                 .curvature_sd = curvature_sd});
  for (double& rate : ego.yaw_rate) {
    rate -= ego.path.gyro_bias;
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    ego.largest_offset = std::max(ego.largest_offset, std::abs(ego.path.poses[k].d));
  }
  const std::size_t before = window.first - first;
  forget(ego.speed, before);
  forget(ego.yaw_rate, before);
  auto& poses = ego.path.poses;
  poses.erase(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(before));
  const double start = poses.front().s;
  for (world::LanePose& pose : poses) {
    pose.s -= start;
  }
  ego.num_speed_missing = static_cast<std::size_t>(
      std::count_if(rows.begin() + static_cast<std::ptrdiff_t>(window.first),
                    rows.begin() + static_cast<std::ptrdiff_t>(window.last) + 1,
                    [](const auto& row) { return std::isnan(row.speed); }));
  return made;
}

}  // namespace saca::importers
