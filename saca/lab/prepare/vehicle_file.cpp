#include "saca/lab/prepare/vehicle_file.h"

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"

namespace saca::prepare {
namespace {

using config::Table;

// Ranges are wide enough for anything with four wheels, and narrow enough to catch a wrong unit.
void read_body(Table table, vehicle::Vehicle& car) {
  car.mass = table.number("mass_kg", {300.0, 60'000.0});
  car.yaw_inertia = table.number("yaw_inertia_kgm2", {100.0, 1e6});
  car.cg_to_front_axle = table.number("front_arm_m", {0.3, 10.0});
  car.cg_to_rear_axle = table.number("rear_arm_m", {0.3, 10.0});
  car.track_width = table.number("track_width_m", {0.5, 3.0});
  car.cg_height = table.number("mass_height_m", {0.1, 3.0});
  car.body_length = table.number("length_m", {1.0, 20.0});
  car.body_width = table.number("width_m", {0.5, 3.0});
  car.front_end = table.number("front_end_m", {0.3, 15.0});
  car.drag_area = table.number("drag_area_m2", {0.0, 20.0});
  car.front_roll_stiffness_share = table.number("front_roll_share", {0.0, 1.0});
  car.load_transfer_lag = table.number("load_transfer_lag_s", {0.01, 1.0});
  if (car.front_end <= car.cg_to_front_axle ||
      car.body_length - car.front_end <= car.cg_to_rear_axle) {
    table.reject("length_m", "want the axles inside the body");
  }
}

void read_wheels(Table table, vehicle::Vehicle& car) {
  car.wheel_radius = table.number("radius_m", {0.15, 0.8});
  car.front_wheel_inertia = table.number("front_inertia_kgm2", {0.5, 50.0});
  car.rear_wheel_inertia = table.number("rear_inertia_kgm2", {0.5, 50.0});
}

void read_tyre(Table table, vehicle::Vehicle& car) {
  car.tyre.stiffness = table.number("stiffness", {5.0, 40.0});
  car.tyre.shape = table.number("shape", {1.05, 1.9});
  car.tyre.load_sensitivity = table.number("load_sensitivity", {0.0, 0.3});
  car.tyre.nominal_load = table.number("nominal_load_N", {500.0, 60'000.0});
}

void read_actuators(Table& root, vehicle::Vehicle& car) {
  Table steering = root.table("steering");
  car.steering_lag = steering.number("lag_s", {0.005, 1.0});
  car.steering_rate = from_degrees(steering.number("rate_degps", {5.0, 500.0}));
  car.steering_limit = from_degrees(steering.number("limit_deg", {5.0, 80.0}));
  Table brakes = root.table("brakes");
  car.brake_dead_time = brakes.number("dead_time_s", {0.0, 0.06});
  car.brake_lag = brakes.number("lag_s", {0.005, 1.0});
  car.brake_limit = brakes.number("torque_limit_Nm", {100.0, 50'000.0});
  Table motor = root.table("motor");
  car.motor_limit = motor.number("torque_limit_Nm", {0.0, 50'000.0});
  car.motor_lag = motor.number("lag_s", {0.005, 1.0});
  car.motor_front_share = motor.number("front_share", {0.0, 1.0});
}

}  // namespace

Result<vehicle::Vehicle> read_vehicle(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return parse_vehicle(text.value(), path.string());
}

Result<vehicle::Vehicle> parse_vehicle(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  vehicle::Vehicle car{};
  (void)root.text("name");
  read_body(root.table("body"), car);
  read_wheels(root.table("wheels"), car);
  read_tyre(root.table("tyre"), car);
  read_actuators(root, car);
  if (!document.value().error().has_value() && vehicle::longest_step(car) < vehicle::usual_step) {
    root.reject("wheels", "want wheels heavy enough, or tyres soft enough, for steps of 1 ms");
  }
  if (const auto error = document.value().error(); error.has_value()) {
    return *error;
  }
  return car;
}

}  // namespace saca::prepare
