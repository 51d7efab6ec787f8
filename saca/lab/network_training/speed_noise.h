#pragma once

#include <torch/torch.h>

#include <cstddef>
#include <random>
#include <vector>

namespace saca::network_training {

/// By how much a noisier tracker would measure the motion of one vehicle wrongly.
///
/// Data augmentation: recordings come from few sites, and each has its own tracker. A network that
/// has seen fast vehicles only where accelerations were measured well takes the noise of another
/// site for braking.
struct SpeedNoise {
  std::vector<double> speed;         ///< added to the speed [m/s]   (T)
  std::vector<double> acceleration;  ///< added to the acceleration [m/s^2]   (T)
};

/// One draw of noise for a piece: an Ornstein-Uhlenbeck process with a correlation time of 1 s. Its
/// standard deviation is drawn first, half-normal, because sites differ. The acceleration errs by
/// the slope of the noise over the last 0.5 s, as of a tracker that differentiates speeds.
///
/// @param sd  root mean square of the noise of the speed over many pieces [m/s], >= 0
[[nodiscard]] SpeedNoise drawn_speed_noise(std::size_t num_frames, double sd,
                                           std::mt19937_64& random);

/// Changes the features of one piece as if its speed and acceleration had been measured with the
/// noise. The vehicle ahead is seen at its true distance and speed.
///
/// @param features  of intent/features.h, contiguous, changed in place   (>= T x num_features)
void add_speed_noise(const torch::Tensor& features, const SpeedNoise& noise);

}  // namespace saca::network_training
