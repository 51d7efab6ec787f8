#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/transfer.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// Cases that recalls are calibrated with.
struct CalibrationCases {
  std::string file;                       ///< where those that are asked come from
  std::vector<memory::Case> cases;        ///< at least one
  std::vector<std::string> check_files;   ///< where other cases come from; empty: there are none
  std::vector<memory::Case> check_cases;  ///< they are held against `cases`
};

/// Reads them.
/// @return  malformed, naming the file, where there is no case in it; else as read_cases
[[nodiscard]] Result<CalibrationCases> read_calibration_cases(
    const std::string& file, const std::vector<std::string>& check_files);

/// From which share of the cases on so large a part of all recalls transfers.
struct LeastShare {
  double part = 0.0;            ///< in [0, 1]
  std::optional<double> share;  ///< eval::least_share
};

/// How often what cases speak for is as good as the best.
struct RecallCalibration {
  std::string file;                                   ///< of the cases that are asked
  std::size_t num_cases = 0;                          ///< in it
  std::uint64_t seed = 1;                             ///< of what is drawn
  std::vector<eval::Transfer> within;                 ///< each of them held against all others
  std::array<LeastShare, 2> least_shares{};           ///< of `within`: for 98 and for 95 %
  std::string check_files;                            ///< names without folders, "a.jsonl, b.jsonl"
  std::optional<std::vector<eval::Transfer>> checks;  ///< other cases held against them
};

/// @param threads  they do not change the result
[[nodiscard]] RecallCalibration calibrate_recalls(const CalibrationCases& cases, std::uint64_t seed,
                                                  int threads);

/// What `saca memory calibrate --json` prints: figures whose names begin with "memory.transfer.",
/// by the ranges of confidence that the gates have.
/// @param version  of the program
[[nodiscard]] nlohmann::json json_of(const RecallCalibration& calibration,
                                     const std::string& version);

/// The same as tables for people.
[[nodiscard]] std::string text_of(const RecallCalibration& calibration);

}  // namespace saca::banks
