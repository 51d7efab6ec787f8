#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "saca/lab/scenario/perception_model.h"

namespace saca::intention_scoring {

/// A slow swing about zero.
struct Oscillation {
  double amplitude = 0.0;
  double period = 10.0;  ///< [s], > 0
  double phase = 0.0;    ///< [rad]

  [[nodiscard]] double at(double time) const;
};

/// One braking: builds up evenly, holds, is let go evenly.
struct BrakingPlan {
  double start = 0.0;             ///< [s]
  double build_up = 0.4;          ///< [s], > 0
  double deceleration = 0.0;      ///< size [m/s^2], >= 0
  std::optional<double> release;  ///< when it is let go [s]; nullopt: never
  double let_go = 0.3;            ///< for how long [s], > 0
};

/// How somebody drives along the lane.
struct SpeedPlan {
  double speed = 0.0;                       ///< at the start [m/s], >= 0
  std::array<Oscillation, 2> oscillations;  ///< of the acceleration [m/s^2]
  std::vector<BrakingPlan> brakings;
};

/// One motion to the side, as `scenario::Script` has it: a quintic in the way made. Where the
/// vehicle is slow it takes longer, and may not end.
struct ShiftPlan {
  double start = 0.0;     ///< [s]
  double duration = 4.0;  ///< if it is not slowed down by more than its own braking [s], > 0
  double aside = 0.0;     ///< > 0: to the left [m]
};

/// Somebody ahead in one lane.
struct LeadPlan {
  double gap = 0.0;  ///< at the start, bumper to bumper [m]
  SpeedPlan speed;
};

/// Everything that is drawn of one simulated vehicle and of how it is seen.
struct DrivePlan {
  double duration = 10.0;   ///< [s]
  double lane_width = 3.5;  ///< [m], > 0
  double curvature = 0.0;   ///< of the road, > 0: to the left [1/m]
  SpeedPlan speed;
  std::array<Oscillation, 2> wandering;  ///< in its lane [m]
  std::vector<ShiftPlan> shifts;         ///< one begins after the other
  std::optional<LeadPlan> lead;
  std::optional<LeadPlan> beside;  ///< in the lanes to either side
  bool shares_pedals = false;
  scenario::PerceptionModel perception;
};

/// Draws what a vehicle does: it just drives, brakes, changes lanes, evades, or does two of them,
/// at once or one after the other; alone or behind somebody, mostly with a reason ahead.
[[nodiscard]] DrivePlan draw_plan(std::mt19937_64& rng);

/// The same on the other side.
[[nodiscard]] DrivePlan mirrored(DrivePlan plan);

/// A true motion in steps of `step` from `first` on.
struct DriveMotion {
  static constexpr double step = 0.01;   ///< [s]: a look of `sim::Perception`
  static constexpr double first = -1.0;  ///< [s]: so that accelerations over 0.5 s are known early
  static constexpr std::size_t before = 100;  ///< samples before time 0

  // One per sample.
  std::vector<double> way;           ///< along the lane from time 0 on, where it is driven [m]
  std::vector<double> speed;         ///< along the lane [m/s], >= 0
  std::vector<double> acceleration;  ///< likewise, over the step that ends there [m/s^2]
  std::vector<double> aside;         ///< of the first lane's centre, to the left [m]
  std::vector<double> slope;         ///< way aside per way along [-]
  /// Bumper to bumper to the one in the lane that the centre is in [m]; infinite: nobody.
  std::vector<double> gap;
  std::vector<double> lead_speed;  ///< [m/s]; NaN without a lead
};

/// Drives a plan. Leads that would come nearer than 2 m begin so much farther ahead.
[[nodiscard]] DriveMotion drive(const DrivePlan& plan);

}  // namespace saca::intention_scoring
