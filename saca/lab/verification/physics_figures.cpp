#include "saca/lab/verification/physics_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/vehicle/prototype.h"

namespace saca::verification {
namespace {

using vehicle::VehicleState;

// Lane changes of the independent prototype (saca/onboard/vehicle/prototype.h).
struct SpeedReference {
  double speed, time;
};
constexpr std::array<SpeedReference, 3> settled_references{{{10, 1.47}, {14, 1.35}, {20, 1.45}}};
// Given as 0.91 to 0.87 s over 10 to 15 m/s; the ends are taken as they stand.
constexpr std::array<SpeedReference, 2> side_references{{{10, 0.91}, {15, 0.87}}};

std::string with_condition(const char* quantity, double speed, double grip) {
  std::array<char, 120> text{};
  (void)std::snprintf(text.data(), text.size(), "physics.%s.v%g.mu%.1f", quantity, speed, grip);
  return text.data();
}

world::Scene straight_scene(double speed, double grip) {
  world::Scene scene;
  scene.ego.v_B = {speed, 0.0};
  scene.grip = grip;
  return scene;
}

constexpr manoeuvre::Plan swerve{.policy = manoeuvre::PolicyId::aes_left,
                                 .target_speed = std::nullopt};

// Commands every millisecond, integrated in `parts` steps each.
VehicleState one_millisecond(const manoeuvre::Car& car, VehicleState state,
                             const world::Scene& scene, manoeuvre::ControllerState& memory,
                             int parts) {
  const auto command =
      manoeuvre::control(car, scene.road, scene.grip, state, memory, vehicle::usual_step);
  for (int i = 0; i < parts; ++i) {
    state = vehicle::step(car, state, command, scene.grip, vehicle::usual_step / parts);
  }
  return state;
}

void add_stops(const manoeuvre::Car& car, std::vector<Figure>& figures) {
  for (const auto& [speed, grip, distance, time] : vehicle::prototype_stops) {
    const Stop ideal = stop_straight(car, Abs::ideal, speed, grip);
    const Stop deployed = stop_straight(car, Abs::deployed, speed, grip);
    figures.push_back({with_condition("aeb_ideal.stop_distance_m", speed, grip), ideal.distance,
                       distance, 0.95 * distance, 1.05 * distance});
    figures.push_back({with_condition("aeb_ideal.stop_time_s", speed, grip), ideal.time, time,
                       0.95 * time, 1.05 * time});
    figures.push_back({with_condition("aeb.stop_distance_m", speed, grip), deployed.distance,
                       distance, 0.97 * distance, 1.12 * distance});
    figures.push_back({with_condition("aeb.stop_time_s", speed, grip), deployed.time, time,
                       0.97 * time, 1.12 * time});
  }
  for (const auto& [grip, peak] : vehicle::prototype_peaks) {
    figures.push_back({with_condition("aeb_ideal.peak_deceleration_mps2", 14.0, grip),
                       stop_straight(car, Abs::ideal, 14.0, grip).peak_deceleration, peak,
                       0.95 * peak, 1.05 * peak});
  }
}

/// Friction lets nobody be so far to the side sooner: all of it, all the way [s].
double least_time_to_the_side(double distance, double grip) {
  return std::sqrt(2.0 * distance / (grip * vehicle::gravity));
}

void add_lane_changes(const manoeuvre::Car& car, std::vector<Figure>& figures) {
  constexpr double grip = 0.9;
  for (const auto& [speed, time] : settled_references) {
    figures.push_back({with_condition("lane_change.settled_s", speed, grip),
                       change_lane(car, speed, grip).settled, time,
                       least_time_to_the_side(3.3, grip), 1.25 * time});
  }
  for (const auto& [speed, time] : side_references) {
    figures.push_back({with_condition("lane_change.to_2.1m_s", speed, grip),
                       change_lane(car, speed, grip).to_2_1_m, time,
                       least_time_to_the_side(2.1, grip), 1.20 * time});
  }
}

void add_swerve_against_braking(const manoeuvre::Car& car, std::vector<Figure>& figures) {
  figures.push_back(
      {"physics.swerve_beats_braking_mps.mu0.9", swerve_beats_braking(car), 13.0, 12.0, 14.0});
}

void add_drifts(const manoeuvre::Car& car, std::vector<Figure>& figures) {
  constexpr double grip = 0.9;
  for (const auto& [speed, time, forward] : vehicle::prototype_drifts) {
    const DriftStop stop = drift_to_rest(car, speed, grip);
    figures.push_back({with_condition("t_drift.stop_time_s", speed, grip), stop.time, time,
                       (1.0 - vehicle::drift_time_band) * time,
                       (1.0 + vehicle::drift_time_band) * time});
    figures.push_back({with_condition("t_drift.forward_m", speed, grip), stop.forward, forward,
                       forward - vehicle::drift_forward_band,
                       forward + vehicle::drift_forward_band});
    figures.push_back({with_condition("t_drift.sideways_m", speed, grip), stop.sideways,
                       vehicle::prototype_drift_sideways, vehicle::drift_least_sideways,
                       vehicle::drift_most_sideways});
    figures.push_back({with_condition("t_drift.heading_deg", speed, grip), to_degrees(stop.heading),
                       90.0, 85.0, 95.0});
  }
}

}  // namespace

bool in_band(const Figure& figure) {
  return figure.value >= figure.low && figure.value <= figure.high;
}

Stop stop_straight(const manoeuvre::Car& car, Abs abs, double speed, double grip) {
  expects(speed > 0.0 && speed <= 25.0, "speed in (0, 25] m/s");
  expects(grip >= 0.2 && grip <= 1.0, "grip in [0.2, 1.0]");
  constexpr int most_steps = 20'000;
  const manoeuvre::Plan plan{.policy = manoeuvre::PolicyId::aeb, .target_speed = std::nullopt};
  const world::Scene scene = straight_scene(speed, grip);
  VehicleState state = manoeuvre::rolling_state(car, scene.ego, grip);
  manoeuvre::ControllerState memory = manoeuvre::begin(car, plan, scene);
  Stop stop;
  for (int i = 1; i <= most_steps && !vehicle::at_rest(state); ++i) {
    vehicle::Command command =
        manoeuvre::control(car, scene.road, grip, state, memory, vehicle::usual_step);
    if (abs == Abs::ideal) {
      command.brake_torque = vehicle::ideal_brakes(car, state, grip);
    }
    state = vehicle::step(car, state, command, grip, vehicle::usual_step);
    stop.time = i * vehicle::usual_step;
    stop.peak_deceleration = std::max(stop.peak_deceleration, -state.a_B.x);
  }
  stop.distance = state.X_WB.p.x;
  return stop;
}

LaneChange change_lane(const manoeuvre::Car& car, double speed, double grip) {
  constexpr int num_steps = 5'000;  // long enough to see that it stays
  const world::Scene scene = straight_scene(speed, grip);
  VehicleState state = manoeuvre::rolling_state(car, scene.ego, grip);
  manoeuvre::ControllerState memory = manoeuvre::begin(car, swerve, scene);
  LaneChange change;
  for (int i = 1; i <= num_steps; ++i) {
    state = one_millisecond(car, state, scene, memory, 1);
    const bool settled = std::abs(state.X_WB.p.y - scene.road.lane_width) <= 0.2 &&
                         std::abs(state.X_WB.yaw) <= from_degrees(2.0);
    if (!settled) {
      change.settled = (i + 1) * vehicle::usual_step;
    }
    if (state.X_WB.p.y < 2.1 && change.to_2_1_m <= (i - 1) * vehicle::usual_step) {
      change.to_2_1_m = i * vehicle::usual_step;
      change.way_to_2_1_m = state.X_WB.p.x;
    }
  }
  return change;
}

double swerve_beats_braking(const manoeuvre::Car& car) {
  constexpr double grip = 0.9;
  double brake = 8.0;    // [m/s] from here braking needs less room
  double swerve = 25.0;  // from here swerving does
  while (swerve - brake > 0.01) {
    const double speed = 0.5 * (brake + swerve);
    const bool swerves = change_lane(car, speed, grip).way_to_2_1_m <
                         stop_straight(car, Abs::deployed, speed, grip).distance;
    (swerves ? swerve : brake) = speed;
  }
  return 0.5 * (brake + swerve);
}

DriftStop drift_to_rest(const manoeuvre::Car& car, double speed, double grip) {
  constexpr double longest = 20.0;  // [s]
  const manoeuvre::EgoMotion motion =
      manoeuvre::drive(car, {manoeuvre::PolicyId::t_drift_left, std::nullopt},
                       straight_scene(speed, grip), grip, longest);
  const Pose& X_WB = motion.track.X_WA.back();
  return {.time = world::end_time(motion.track),
          .forward = X_WB.p.x,
          .sideways = X_WB.p.y,
          .heading = X_WB.yaw};
}

IntegrationError integration_error(const manoeuvre::Car& car) {
  constexpr int num_steps = 2'000;
  const world::Scene scene = straight_scene(14.0, 0.9);
  VehicleState coarse = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  VehicleState fine = coarse;
  manoeuvre::ControllerState coarse_memory = manoeuvre::begin(car, swerve, scene);
  manoeuvre::ControllerState fine_memory = coarse_memory;
  for (int i = 0; i < num_steps; ++i) {
    coarse = one_millisecond(car, coarse, scene, coarse_memory, 1);
    fine = one_millisecond(car, fine, scene, fine_memory, 4);
  }
  return {.position = norm(coarse.X_WB.p - fine.X_WB.p),
          .heading = std::abs(wrap_angle(coarse.X_WB.yaw - fine.X_WB.yaw))};
}

double integration_order(const manoeuvre::Car& car) {
  constexpr double seconds = 0.8;
  const auto end_y = [&](double dt) {
    VehicleState state = manoeuvre::rolling_state(car, straight_scene(15.0, 0.9).ego, 0.9);
    vehicle::Command command;
    command.steering = 0.045;  // followed below the steering's rate limit
    command.motor_torque = 900.0;
    for (long i = 0; i < std::lround(seconds / dt); ++i) {
      state = vehicle::step(car, state, command, 0.9, dt);
    }
    return state.X_WB.p.y;
  };
  const double exact = end_y(0.0625e-3);
  return std::log2(std::abs(end_y(1e-3) - exact) / std::abs(end_y(0.5e-3) - exact));
}

std::vector<Figure> physics_figures(const manoeuvre::Car& car) {
  std::vector<Figure> figures;
  add_stops(car, figures);
  add_lane_changes(car, figures);
  add_swerve_against_braking(car, figures);
  add_drifts(car, figures);
  const IntegrationError error = integration_error(car);
  figures.push_back({"physics.rk4.position_error_m", error.position, std::nullopt, 0.0, 0.008});
  figures.push_back(
      {"physics.rk4.heading_error_deg", to_degrees(error.heading), std::nullopt, 0.0, 0.08});
  figures.push_back({"physics.rk4.order", integration_order(car), 4.0, 3.6, 4.4});
  return figures;
}

}  // namespace saca::verification
