#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/tune/draws.h"

namespace saca::report {

/// One instant of a manoeuvre.
struct DriveSample {
  double time = 0.0;  ///< [s]
  vehicle::VehicleState state;
  vehicle::Command command;
  vehicle::WheelContacts contacts{};
};

/// The same manoeuvre again and again.
struct DriveDraws {
  std::uint64_t seed = 0;
  std::vector<tune::Ending> endings;  ///< at least one
};

/// One manoeuvre of one car.
struct DriveRecord {
  std::string program;  ///< name and version
  std::string command;  ///< the line that made it
  std::string car_name;
  manoeuvre::Car car;
  manoeuvre::Plan plan;
  world::Scene scene;                ///< at the start
  std::vector<DriveSample> samples;  ///< equal steps in time; at least one
  bool ended = false;                ///< in its safe state; else the horizon came first
  std::optional<DriveDraws> draws;
};

/// Rides to the end of the manoeuvre or of the horizon [s]; a sample every 10 ms.
/// @throws ContractViolation  if refusal(car, plan, scene) has a reason
void ride_into(DriveRecord& record, double horizon);

/// The record as JSON, schema `saca.drive/1`: see docs/formats.md.
[[nodiscard]] std::string drive_json(const DriveRecord& record);

}  // namespace saca::report
