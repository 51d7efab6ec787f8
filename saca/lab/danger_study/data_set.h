#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "saca/base/core/journal.h"
#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/thinking/danger/danger.h"

namespace saca::danger_study {

/// Whether solved tables of danger are used, or only what needs none.
enum class TableUse { none, solved };

/// Which data set of transitions is to be made, and where.
struct DataSetTask {
  std::filesystem::path folder;  ///< of the parts
  std::string car_as_asked_for;  ///< its name or its file, as its reader is to be told
  prepare::NamedCar car;
  std::int64_t transitions = 0;  ///< at least so many
  std::uint64_t seed = 1;
  int drives_per_part = 500;
  TableUse tables = TableUse::solved;              ///< what the model of danger has
  std::optional<learned_danger::Network> network;  ///< by which evasions are driven
  bool outcomes = false;  ///< all drives by it, to the end (Mixture::outcomes)
  int threads = 1;        ///< they do not change what is made
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// What a part, or all of them, hold.
struct DataSetCounts {
  std::int64_t transitions = 0;
  std::int64_t drives = 0;
  std::int64_t situations = 0;
  std::int64_t near = 0;  ///< situations that start near the boundary
  std::int64_t bytes = 0;
  bool operator==(const DataSetCounts&) const = default;
};

/// A data set that is made part by part (part_00000.h5, ...); what was made stands in journal.txt,
/// so that the same task goes on from there.
class DataSet {
 public:
  /// Makes its folder, if it is not there, and reads or begins its journal.
  /// @return  Error::Code::malformed: the folder holds the data set of another task; unwritable
  [[nodiscard]] static Result<DataSet> open(DataSetTask task);

  /// Makes what is missing, with progress on the error stream, and a README.md for the set.
  /// @param model  of the car, with the tables that the task names
  /// @return  what all parts hold; Error::Code::too_late: interrupted, which is to be watched for;
  ///          unwritable
  [[nodiscard]] Result<DataSetCounts> make(const danger::DangerModel& model);

 private:
  DataSet(DataSetTask task, Journal journal);
  [[nodiscard]] std::filesystem::path file_of(std::size_t part) const;
  [[nodiscard]] DataSetCounts all_until(std::size_t end) const;
  [[nodiscard]] std::optional<Error> make_some(const danger::DangerModel& model, std::size_t first);
  [[nodiscard]] std::optional<Error> make_all(const danger::DangerModel& model);

  DataSetTask task_;
  Journal journal_;
  std::map<std::size_t, DataSetCounts> made_;
};

/// As the journal has a part.
[[nodiscard]] std::string part_line(std::size_t part, const DataSetCounts& one);
/// And back; nullopt: no such line.
[[nodiscard]] std::optional<std::pair<std::size_t, DataSetCounts>> part_from(
    const std::string& line);

/// danger.dataset.: what there is and how long it took; meta.car, meta.seed, meta.threads.
[[nodiscard]] nlohmann::json json_of(const DataSetTask& task, const DataSetCounts& all,
                                     double seconds);

/// Two lines.
[[nodiscard]] std::string text_of(const DataSetTask& task, const DataSetCounts& all);

}  // namespace saca::danger_study
