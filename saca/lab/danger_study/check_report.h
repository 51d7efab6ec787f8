#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/learned_danger/check.h"
#include "saca/lab/learned_danger/margins.h"

namespace saca::danger_study {

/// What a network is worth, over some of the situations.
struct CheckRow {
  std::string name;                  ///< for people
  std::string place;                 ///< of its figures: "danger.net.one."
  std::string margin;                ///< that all of them share, for people; empty: each its own
  std::optional<double> bin_margin;  ///< of a bin [m]
  learned_danger::CheckFigures figures;
};

/// All that is told of a check.
struct CheckReport {
  double value_us = 0.0;  ///< that a value takes, of 32 at once
  std::vector<CheckRow> rows;
  learned_danger::CheckFigures all;  ///< each with its margin
};

/// Rows: all without a margin; with margins, each of their bins and all; those with one obstacle
/// and with several.
[[nodiscard]] CheckReport check_report(const std::vector<learned_danger::CheckedCase>& all,
                                       const std::optional<learned_danger::Margins>& margins,
                                       double value_us);

/// danger.net.: figures of each row under its place (docs/formats.md).
[[nodiscard]] nlohmann::json json_of(const CheckReport& report);

/// A table, and a sentence about pincers.
[[nodiscard]] std::string text_of(const CheckReport& report);

}  // namespace saca::danger_study
