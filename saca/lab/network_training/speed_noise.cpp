#include "saca/lab/network_training/speed_noise.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/features.h"

namespace saca::network_training {
namespace {

using intent::Feature;

constexpr double most = 3.0;  // features are clipped there: intent/features.cpp

/// The features of one frame, in place.
class FrameFeatures {
 public:
  explicit FrameFeatures(float* values) : values_(values) {}
  [[nodiscard]] double operator[](Feature which) const {
    return static_cast<double>(values_[static_cast<std::size_t>(which)]);
  }
  void set(Feature which, double value) {
    values_[static_cast<std::size_t>(which)] = static_cast<float>(std::clamp(value, -most, most));
  }
  void add(Feature which, double change) { set(which, (*this)[which] + change); }

 private:
  float* values_;
};

/// The noise's slope over so many steps, or as many as there are [m/s^2].
double slope(const std::vector<double>& noise, std::size_t t, std::size_t steps) {
  const std::size_t over = std::min(steps, t);
  return over == 0 ? 0.0
                   : (noise[t] - noise[t - over]) / (static_cast<double>(over) * intent::look_step);
}

/// Of what lies ahead, by the inverse of intent/features.cpp.
/// @param speed   with noise [m/s]
/// @param change  of the speed [m/s]
void change_ahead(FrameFeatures frame, double speed, double change) {
  const double gap = std::max(1.0, -20.0 * std::log(frame[Feature::nearness]));
  const double closing = 5.0 * frame[Feature::closing] + change;
  frame.set(Feature::time_gap, std::exp(-gap / std::max(speed, 1.0) / 2.0));
  frame.set(Feature::closing, closing / 5.0);
  frame.set(Feature::closing_time, closing / gap);
  frame.set(Feature::needed_deceleration,
            closing > 0.0 ? closing * closing / (2.0 * gap) / 3.0 : 0.0);
}

}  // namespace

SpeedNoise drawn_speed_noise(std::size_t num_frames, double sd, std::mt19937_64& random) {
  expects(sd >= 0.0, "sd >= 0");
  constexpr double correlation_time = 1.0;  // [s], an assumption
  constexpr std::size_t slope_steps = 5;    // 0.5 s, likewise
  const double kept = std::exp(-intent::look_step / correlation_time);
  const double fresh = std::sqrt(1.0 - kept * kept);
  std::normal_distribution<double> normal;
  const double level = sd * std::abs(normal(random));
  std::vector<double> process(num_frames + slope_steps);
  double last = normal(random);
  for (double& each : process) {
    each = level * last;
    last = kept * last + fresh * normal(random);
  }
  SpeedNoise noise;
  for (std::size_t t = 0; t < num_frames; ++t) {
    noise.speed.push_back(process[t + slope_steps]);
    noise.acceleration.push_back(slope(process, t + slope_steps, slope_steps));
  }
  return noise;
}

void add_speed_noise(const torch::Tensor& features, const SpeedNoise& noise) {
  expects(noise.speed.size() == noise.acceleration.size() &&
              static_cast<std::int64_t>(noise.speed.size()) <= features.size(0),
          "noise of each frame, and features of as many");
  expects(features.is_contiguous(), "contiguous features");
  auto* const values = features.data_ptr<float>();
  for (std::size_t t = 0; t < noise.speed.size(); ++t) {
    FrameFeatures frame(values + t * intent::num_features);
    const double change = noise.speed[t];
    if (frame[Feature::somebody_ahead] != 0.0) {
      change_ahead(frame, 30.0 * frame[Feature::speed] + change, change);
    }
    frame.add(Feature::speed, change / 30.0);
    frame.add(Feature::acceleration, noise.acceleration[t] / 3.0);
    frame.add(Feature::slope_03, slope(noise.speed, t, 3) / 3.0);
    frame.add(Feature::slope_05, slope(noise.speed, t, 5) / 3.0);
    frame.add(Feature::slope_10, slope(noise.speed, t, 10) / 3.0);
    frame.add(Feature::slope_20, slope(noise.speed, t, 20) / 3.0);
    frame.add(Feature::lateral_acceleration, 0.1 * frame[Feature::yaw_rate] * change / 2.0);
    frame.add(Feature::steered_speed, 0.05 * frame[Feature::heading] * change);
  }
}

}  // namespace saca::network_training
