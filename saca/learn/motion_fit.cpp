#include "saca/learn/motion_fit.h"

#include <algorithm>
#include <cmath>

#include "saca/core/contract.h"
#include "saca/intent/intention.h"
#include "saca/learn/sequence.h"

namespace saca::learn {
namespace {

using intent::Intention;

constexpr std::size_t longest_lag = 50;    // frames of autocorrelation
constexpr double peak_of_quintic = 1.875;  // highest speed over mean speed of a 5th-order change

/// What is gathered of all motions.
struct Gathered {
  std::vector<double> braking;
  std::vector<double> rise;
  std::vector<double> held;
  std::vector<double> lane_change;
  std::vector<double> products = std::vector<double>(longest_lag + 1, 0.0);
  std::vector<double> counts = std::vector<double>(longest_lag + 1, 0.0);
};

bool brakes(std::uint8_t label) {
  return intent::is_braking(static_cast<Intention>(label));
}

/// Frames [first, last) of one braking.
void gather_braking(const TrueMotion& motion, std::size_t first, std::size_t last,
                    Gathered& gathered) {
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
  constexpr std::size_t second = 10;  // frames
  for (std::size_t i = first; i + second < std::min(last + second, motion.acceleration.size());
       i += second) {
    double next = 0.0;
    for (std::size_t j = 1; j <= second; ++j) {
      next -= motion.acceleration[i + j] / static_cast<double>(second);
    }
    if (next > 0.0) {
      gathered.held.push_back(next / -motion.acceleration[i]);
    }
  }
}

void gather_lane_change(const TrueMotion& motion, std::size_t first, std::size_t last,
                        double lane_width, Gathered& gathered) {
  double fastest = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    fastest = std::max(fastest, std::abs(motion.lateral_speed[i]));
  }
  // Cut off at neither end: its highest speed was seen.
  if (first > 0 && last < motion.lateral_speed.size()) {
    gathered.lane_change.push_back(peak_of_quintic * lane_width / fastest);
  }
}

void gather_wavering(const TrueMotion& motion, const Labels& labels, Gathered& gathered) {
  const auto maintains = [&](std::size_t i) { return labels.classes[i] == 0 && labels.scored[i]; };
  for (std::size_t i = 0; i < labels.classes.size(); ++i) {
    if (!maintains(i)) {
      continue;
    }
    for (std::size_t lag = 0; lag <= longest_lag && i + lag < labels.classes.size(); ++lag) {
      if (maintains(i + lag)) {
        gathered.products[lag] += motion.acceleration[i] * motion.acceleration[i + lag];
        gathered.counts[lag] += 1.0;
      }
    }
  }
}

void gather(const TrueMotion& motion, double lane_width, Gathered& gathered) {
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
  gather_wavering(motion, labels, gathered);
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
  Gathered gathered;
  for (const TrueMotion& motion : motions) {
    gather(motion, lane_width, gathered);
  }
  MotionFit fit{.braking = log_normal(gathered.braking),
                .rise = log_normal(gathered.rise),
                .held = log_normal(gathered.held),
                .lane_change = log_normal(gathered.lane_change)};
  if (gathered.counts[0] > 0.0) {
    const double variance = gathered.products[0] / gathered.counts[0];
    fit.acceleration_sd = std::sqrt(variance);
    std::size_t lag = 0;
    while (lag < longest_lag && gathered.counts[lag] > 0.0 &&
           gathered.products[lag] / gathered.counts[lag] > variance / std::exp(1.0)) {
      ++lag;
    }
    fit.acceleration_time = static_cast<double>(lag) * frame_step;
  }
  return fit;
}

}  // namespace saca::learn
