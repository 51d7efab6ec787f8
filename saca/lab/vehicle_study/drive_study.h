#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/report/drive_json.h"

namespace saca::vehicle_study {

/// One manoeuvre on an empty straight road, as it is asked for.
struct DriveQuestion {
  manoeuvre::PolicyId policy = manoeuvre::PolicyId::aeb;
  double speed = 14.0;                 ///< at the start [m/s]
  double grip = 0.9;                   ///< friction coefficient [-]
  std::optional<double> target_speed;  ///< [m/s]; nullopt: the policy's default plan's
  std::optional<double> strength;      ///< share of the grip; nullopt: all of it
  std::string car;                     ///< as it was named
  std::optional<double> seconds;       ///< watched no longer than this; nullopt: 30 s, and of doing
                                       ///< nothing, which does not end, 3 s
  int draws = 0;                       ///< with what the controller does not know
  std::uint64_t seed = 1;              ///< of the draws
  int threads = 1;                     ///< they do not change the result
};

/// The line that asks for it.
[[nodiscard]] std::string command_line(const DriveQuestion& question);

/// The record before the drive: plan, car, and the scene at the start.
/// @param program   name and version
/// @param car_name  without its folder
[[nodiscard]] report::DriveRecord record_of(const DriveQuestion& question,
                                            const std::string& program, const std::string& car_name,
                                            const manoeuvre::Car& car);

/// Drives it, once as known and once for each draw; of 50 draws the path is kept.
/// @return  nullopt; Error::Code::out_of_range: the policy cannot be driven from there, and why
[[nodiscard]] std::optional<Error> drive_into(report::DriveRecord& record,
                                              const DriveQuestion& question);

/// For people: what a record says of the end, and of the draws.
/// @param record  as report::drive_json has it
[[nodiscard]] std::string text_of_drive(const nlohmann::json& record);

}  // namespace saca::vehicle_study
