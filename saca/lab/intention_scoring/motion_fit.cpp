#include "saca/lab/intention_scoring/motion_fit.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring {
namespace {

using intent::Intention;

constexpr std::size_t one_second = 10;           // frames
constexpr std::size_t acceleration_frames = 30;  // frames over which acceleration is measured
constexpr double longest_correlation = 50.0;     // [s]: beyond it an acceleration is constant
constexpr double peak_of_quintic = 1.875;  // highest speed over mean speed of a 5th-order change

/// What is gathered of all motions.
struct MotionSamples {
  std::vector<double> braking;
  std::vector<double> rise;
  std::vector<double> held;
  std::vector<double> lane_change;
  /// Of those who maintain for `acceleration_frames`: sums of squares of the way beyond that at the
  /// speed of the beginning [m^2].
  double after_one_second = 0.0;
  double after_all = 0.0;
  std::size_t num_maintaining = 0;
};

bool brakes(std::uint8_t label) {
  return intent::is_braking(static_cast<Intention>(label));
}

/// Frames [first, last) of one braking.
void gather_braking(const TrueMotion& motion, std::size_t first, std::size_t last,
                    MotionSamples& gathered) {
  const auto begin = motion.acceleration.begin();
  const auto hardest = std::min_element(begin + static_cast<std::ptrdiff_t>(first),
                                        begin + static_cast<std::ptrdiff_t>(last));
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    sum -= motion.acceleration[i];
  }
  gathered.braking.push_back(sum / static_cast<double>(last - first));
  auto half = hardest;
  while (half != begin && *half < 0.5 * *hardest) {
    --half;
  }
  if (half != begin && half != hardest) {
    gathered.rise.push_back(2.0 * static_cast<double>(hardest - half) * frame_step);
  }
  for (std::size_t i = first;
       i + one_second < std::min(last + one_second, motion.acceleration.size()); i += one_second) {
    double next = 0.0;
    for (std::size_t j = 1; j <= one_second; ++j) {
      next -= motion.acceleration[i + j] / static_cast<double>(one_second);
    }
    if (next > 0.0) {
      gathered.held.push_back(next / -motion.acceleration[i]);
    }
  }
}

void gather_lane_change(const TrueMotion& motion, std::size_t first, std::size_t last,
                        double lane_width, MotionSamples& gathered) {
  double fastest = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    fastest = std::max(fastest, std::abs(motion.lateral_speed[i]));
  }
  // Cut off at neither end: its highest speed was seen.
  if (first > 0 && last < motion.lateral_speed.size()) {
    gathered.lane_change.push_back(peak_of_quintic * lane_width / fastest);
  }
}

void gather_acceleration(const TrueMotion& motion, const Labels& labels, MotionSamples& gathered) {
  std::size_t maintained = 0;  // frames until now
  for (std::size_t end = 0; end < labels.classes.size(); ++end) {
    maintained = labels.classes[end] == 0 && labels.scored[end] ? maintained + 1 : 0;
    if (maintained <= acceleration_frames) {
      continue;
    }
    double speed = 0.0;  // gained
    double way = 0.0;
    for (std::size_t i = 1; i <= acceleration_frames; ++i) {
      const double now = motion.acceleration[end - acceleration_frames + i];
      way += frame_step * (speed + 0.5 * frame_step * now);
      speed += frame_step * now;
      if (i == one_second) {
        gathered.after_one_second += way * way;
      }
    }
    gathered.after_all += way * way;
    ++gathered.num_maintaining;
  }
}

/// The process of acceleration that carries as far after 1 s and after all as was measured.
intent::OrnsteinUhlenbeck acceleration_of(const MotionSamples& gathered) {
  if (!(gathered.after_one_second > 0.0)) {
    return {};
  }
  const auto unit = [](double time, std::size_t frames) {
    return intent::ornstein_uhlenbeck_sd({1.0, time}, static_cast<double>(frames) * frame_step);
  };
  const double wanted = std::sqrt(gathered.after_all / gathered.after_one_second);
  double low = frame_step;
  double high = longest_correlation;
  for (int i = 0; i < 40; ++i) {  // the longer it is correlated, the greater is the ratio
    const double middle = std::sqrt(low * high);
    (unit(middle, acceleration_frames) < wanted * unit(middle, one_second) ? low : high) = middle;
  }
  const auto num = static_cast<double>(gathered.num_maintaining);
  return {std::sqrt(gathered.after_all / num) / unit(low, acceleration_frames), low};
}

void gather(const TrueMotion& motion, double lane_width, MotionSamples& gathered) {
  const Labels labels = labels_of(motion);
  const auto for_each_run = [&](auto&& belongs, auto&& found) {
    for (std::size_t i = 0; i < labels.classes.size(); ++i) {
      std::size_t end = i;
      while (end < labels.classes.size() && belongs(labels.classes[end])) {
        ++end;
      }
      if (end > i) {
        found(i, end);
        i = end;
      }
    }
  };
  for_each_run(brakes, [&](std::size_t first, std::size_t last) {
    gather_braking(motion, first, last, gathered);
  });
  for (const auto& [plain, braking] : {std::pair(Intention::lane_left, Intention::brake_left),
                                       std::pair(Intention::lane_right, Intention::brake_right)}) {
    for_each_run(
        [a = plain, b = braking](std::uint8_t label) {
          return label == static_cast<std::uint8_t>(a) || label == static_cast<std::uint8_t>(b);
        },
        [&](std::size_t first, std::size_t last) {
          gather_lane_change(motion, first, last, lane_width, gathered);
        });
  }
  gather_acceleration(motion, labels, gathered);
}

}  // namespace

LogNormal log_normal(const std::vector<double>& values) {
  LogNormal fit{.num = values.size()};
  if (values.size() < 2) {
    return fit;
  }
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    expects(value > 0.0, "positive values");
    sum += std::log(value);
    squares += std::log(value) * std::log(value);
  }
  const auto n = static_cast<double>(values.size());
  fit.log_sd = std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1.0)));
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  fit.median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  return fit;
}

MotionFit motion_fit(const std::vector<TrueMotion>& motions, double lane_width) {
  expects(lane_width > 0.0, "lane_width > 0");
  MotionSamples gathered;
  for (const TrueMotion& motion : motions) {
    gather(motion, lane_width, gathered);
  }
  return {.braking = log_normal(gathered.braking),
          .rise = log_normal(gathered.rise),
          .held = log_normal(gathered.held),
          .lane_change = log_normal(gathered.lane_change),
          .acceleration = acceleration_of(gathered)};
}

}  // namespace saca::intention_scoring
