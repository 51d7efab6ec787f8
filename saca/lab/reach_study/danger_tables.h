#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/thinking/danger/danger.h"
#include "saca/thinking/danger/danger_cases.h"
#include "saca/thinking/danger/value_file.h"

/// Tables of danger that runs need: read where they are kept, else solved and kept.
namespace saca::reach_study {

/// On which they are solved: dry. All other grips follow by scaling.
constexpr double table_grip = 0.9;

/// Where a car's tables are kept, and who hears of what happens there.
struct TableStore {
  std::function<std::filesystem::path(const std::string& table)> place;  ///< of its file
  /// Takes what people should know though all goes on.
  std::function<void(const std::string& message)> notice = [](const std::string&) {};
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// The tables that these bodies need on this grip or more.
/// @return  an error naming the car where it is beyond what a table may hold
[[nodiscard]] Result<std::vector<danger::DangerCase>> tables_for(
    const prepare::NamedCar& car, double grip, const std::vector<danger::ObstacleKind>& bodies);

struct ReadyTable {
  danger::Solution table;
  std::filesystem::path file;
  bool was_there = false;         ///< and right for this car; else it was solved
  std::optional<Error> not_kept;  ///< why it could not be written
};

/// Reads a table; solves it, in seconds, with progress on the error stream, where it is not there.
/// A program that already makes tables in that folder is waited for, which is noticed.
/// @return  an error where a car's limits are beyond what can be solved
[[nodiscard]] Result<ReadyTable> ready_table(const danger::DangerCase& wanted,
                                             const TableStore& store);

/// All of them, as a danger::DangerModel takes them. What could not be kept is used all the same,
/// which is noticed.
/// @return  likewise
[[nodiscard]] Result<std::vector<danger::DangerTable>> ready_tables(
    const std::vector<danger::DangerCase>& cases, const TableStore& store);

}  // namespace saca::reach_study
