#pragma once

#include <array>
#include <string_view>

namespace saca::manoeuvre {

/// The numbers of the lane-change controller (policies 1 to 4), as `control` uses them.
struct SwerveLaw {
  double share;         ///< of the grip, used to the side at constant speed [-]
  double braked_share;  ///< likewise while braking [-]
  double fast_less;     ///< of either share, given up for each m/s above 18 m/s [s/m]
  double lag;           ///< from a steering command to its force, foreseen by the path [s]
  double frequency;     ///< of the return to the path [rad/s]
  double damping;       ///< of it [-]
  double guard_from;    ///< rear slip over its peak, where turning in is cut back [-]
  double guard_width;   ///< from there to where none of it is left [-]
};

/// The numbers of the T-drift (policies 5 and 6): see drift.h.
struct DriftLaw {
  double turning;        ///< the larger, the earlier it turns [-], > 0
  double most_turning;   ///< largest turning rate asked for [rad/s], > 0
  double gain;           ///< demand over missing turning rate [s/rad], > 0
  double lead;           ///< by which turning is foreseen, for the actuators' delay [s], >= 0
  double front_release;  ///< share of the front brakes opened at full demand [-], in [0, 1]
  double rear_release;   ///< likewise of the rear ones, at the opposite demand [-], in [0, 1]
  double outer_release;  ///< likewise of the side away from the demanded turn [-], in [0, 1]
  double motor_share;    ///< motor torque at full demand, of what the car's weight holds on the
                         ///< road, or of the motor's limit where that is less [-], in [-1, 1]
  double steering;       ///< off the direction of motion, at full demand [rad], > 0
  double slide_share;    ///< of the grip, that slows a sliding car [-], in (0, 1.2]
  double lock_speed;     ///< below it all wheels are locked [m/s], > 0
};

/// Where the T-drift ends within 10 deg of across a straight lane in at least 90 % of the draws:
/// from which speed to which, for some grips. Between them the lines that join two, where both have
/// such speeds.
struct DriftDomain {
  static constexpr std::array<double, 6> grips{0.2, 0.3, 0.5, 0.7, 0.9, 1.0};  ///< [-]
  std::array<double, grips.size()> slowest;                                    ///< [m/s]
  std::array<double, grips.size()> fastest;  ///< [m/s]; less than `slowest` where no speed will do
};

/// Highest speed at which any manoeuvre but braking may begin [m/s].
constexpr double fastest = 25.0;

/// The slowest and the fastest speed [m/s] from which the T-drift may begin.
struct SpeedRange {
  double slowest;
  double fastest;
};
/// @param grip  in [0.2, 1.0]
[[nodiscard]] SpeedRange drift_speeds(const DriftDomain& domain, double grip) noexcept;

/// What `saca tune` finds for one car.
struct Tuning {
  SwerveLaw swerve;
  DriftLaw drift;
  DriftDomain domain;
};

/// A number of a law: its key in files, and where a sensible value can lie.
template <class Law>
struct Number {
  std::string_view key;
  double Law::*member;
  double min;
  double max;
};

inline constexpr std::array<Number<SwerveLaw>, 8> swerve_numbers{
    {{"share", &SwerveLaw::share, 0.5, 0.97},
     {"braked_share", &SwerveLaw::braked_share, 0.4, 0.76},
     {"fast_less_spm", &SwerveLaw::fast_less, 0.0, 0.06},
     {"lag_s", &SwerveLaw::lag, 0.0, 0.15},
     {"frequency_radps", &SwerveLaw::frequency, 3.0, 14.0},
     {"damping", &SwerveLaw::damping, 0.5, 1.5},
     {"guard_from", &SwerveLaw::guard_from, 0.3, 1.2},
     {"guard_width", &SwerveLaw::guard_width, 0.2, 1.5}}};

inline constexpr std::array<Number<DriftLaw>, 11> drift_numbers{
    {{"turning", &DriftLaw::turning, 0.8, 3.0},
     {"most_turning_radps", &DriftLaw::most_turning, 0.8, 4.0},
     {"gain_sprad", &DriftLaw::gain, 1.0, 15.0},
     {"lead_s", &DriftLaw::lead, 0.0, 0.25},
     {"front_release", &DriftLaw::front_release, 0.0, 1.0},
     {"rear_release", &DriftLaw::rear_release, 0.0, 1.0},
     {"outer_release", &DriftLaw::outer_release, 0.0, 1.0},
     {"motor_share", &DriftLaw::motor_share, -1.0, 1.0},
     {"steering_rad", &DriftLaw::steering, 0.02, 0.6},
     {"slide_share", &DriftLaw::slide_share, 0.6, 1.1},
     {"lock_speed_mps", &DriftLaw::lock_speed, 0.2, 1.5}}};

}  // namespace saca::manoeuvre
