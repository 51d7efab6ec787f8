#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/rate.h"
#include "saca/lab/suites/shadow.h"

namespace saca::suites {

/// One recorded vehicle as the ego.
struct ShadowRow {
  std::string source;    ///< "us101", "lankershim", "100car"
  std::string drive;     ///< names it within the source
  std::string left_out;  ///< why it is not watched; empty: it is
  bool failed = false;   ///< likewise: SACA threw
  ShadowDrive watched;
};

/// A row as one line of a journal.
[[nodiscard]] std::string line_of(const ShadowRow& row);
/// And back.
/// @return  Error::Code::malformed
[[nodiscard]] Result<ShadowRow> shadow_row_from(std::string_view line);

/// How often one thing was seen, and how often without need.
struct ShadowCounts {
  eval::Rate per_hour;
  eval::Rate per_1000km;
  eval::Rate false_per_hour;
  eval::Rate false_per_1000km;
  int danger = 0;
  int at_rest = 0;  ///< of an ego slower than 0.5 m/s, which could do nothing
  std::map<eval::ShadowReason, int> reasons;
};

/// Many drives together. Rates are per hour watched and per 1,000 km driven.
struct ShadowFigures {
  int drives = 0;
  int left_out = 0;
  int failed = 0;  ///< of these, in which SACA threw
  double hours = 0.0;
  double kilometres = 0.0;
  eval::Rate previews_per_hour;
  eval::Rate previews_per_1000km;
  ShadowCounts triggers;
  ShadowCounts interventions;
  int early = 0;  ///< of the interventions, before T1
};

/// @param source  empty: all. Without exposure all rates are 0.
[[nodiscard]] ShadowFigures shadow_figures(std::span<const ShadowRow> rows,
                                           std::string_view source);

}  // namespace saca::suites
