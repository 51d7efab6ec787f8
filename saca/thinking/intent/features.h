#pragma once

#include <array>
#include <cstddef>

#include "saca/thinking/intent/observation.h"

namespace saca::intent {

/// Seconds from one observation to the next.
constexpr double look_step = 0.1;

/// What the network is shown of one road user at one instant; every number has about unit size. A
/// quantity that is not known is 0, and a mask beside it says so.
///
/// The second group changes its sign in the mirror; the others do not. Looks back: differences and
/// slopes over what is remembered, so that the noise of one look matters little.
enum class Feature : std::size_t {
  speed,         ///< [30 m/s]
  acceleration,  ///< [3 m/s^2]
  slope_03,      ///< of speed over the last 0.3 s [3 m/s^2]
  slope_05,
  slope_10,
  slope_20,
  lane_known,   ///< mask of all that is told against the lane
  lane_width,   ///< less 3.5 m [m]
  ahead_known,  ///< mask of what is ahead
  somebody_ahead,
  nearness,             ///< exp(-gap / 20 m)
  time_gap,             ///< gap over speed, as exp(-t / 2 s)
  closing,              ///< rate at which the gap shrinks [5 m/s]
  closing_time,         ///< closing speed over gap [1/s], at most 3
  needed_deceleration,  ///< closing speed squared over twice the gap [3 m/s^2], at most 3
  lead_slope_05,        ///< of the speed of the one ahead over the last 0.5 s [3 m/s^2]
  lead_slope_10,
  throttle_known,  ///< mask
  throttle,
  brake_known,  ///< mask
  brake,
  steering_known,  ///< mask
  memory,          ///< how much of 2 s is remembered, 0 to 1
  to_line,         ///< from its centre to the nearer bound of its lane [m]

  yaw_rate,              ///< [0.1 rad/s]
  lateral_acceleration,  ///< yaw rate times speed [2 m/s^2]
  offset,                ///< [m]
  lateral_speed,         ///< [m/s]
  heading,               ///< [0.05 rad]
  steered_speed,         ///< heading times speed [m/s]
  moved_03,              ///< lateral way over the last 0.3 s, as a speed [m/s]
  moved_05,
  moved_10,
  moved_20,
  sped_05,  ///< change of the lateral speed over the last 0.5 s [m/s^2]
  sped_10,
  lateral_way,  ///< lateral way over the last 2 s [m]
  steering,     ///< [0.05 rad]
  count
};
constexpr std::size_t num_features = static_cast<std::size_t>(Feature::count);
constexpr Feature first_mirrored = Feature::yaw_rate;

using Features = std::array<float, num_features>;

/// The same seen in a mirror: left is right.
[[nodiscard]] Features mirrored(Features features);

/// What is remembered of one road user: its last 2 s, at steps of look_step. Fixed in size.
class ObservationHistory {
 public:
  void add(const Observation& observation);
  /// @throws ContractViolation  before the first observation
  [[nodiscard]] Features features() const;
  void clear() { num_seen_ = 0; }

 private:
  static constexpr std::size_t capacity = 21;  // 2 s and now

  struct Look {
    Observation seen;
    double lateral = 0.0;       ///< way to the left since the lane was last found [m]
    std::size_t in_lane = 0;    ///< for so many steps the lane has been known without a break
    std::size_t with_lead = 0;  ///< likewise for the one ahead
  };

  [[nodiscard]] const Look& back(std::size_t steps) const;
  /// How a value changes, over as much of the time as is remembered [1/s]; 0 where that is nothing.
  /// @param steps  back, at most
  /// @param known  for so many it has been known without a break
  [[nodiscard]] double slope(double (*value)(const Look&), std::size_t steps,
                             std::size_t known) const;
  void tell_motion(Features& f) const;
  void tell_lane(Features& f) const;
  void tell_lead(Features& f) const;

  std::array<Look, capacity> looks_{};
  std::size_t num_seen_ = 0;
};

}  // namespace saca::intent
