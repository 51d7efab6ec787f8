#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"

namespace saca::crash_records {

/// Of a range of a record's family: "recorded: ..." names the columns that narrow it; all else is
/// assumed, by the record's crash type ("by the crash: ...") or as in the shipped family.
constexpr std::string_view recorded_prefix = "recorded: ";
constexpr std::string_view by_crash_prefix = "by the crash: ";

/// A speed with its uncertainty, and who says so.
struct RecordedSpeed {
  Span span;              ///< [m/s]
  bool recorded = false;  ///< else by the speed limit
  std::string source;

  [[nodiscard]] double middle() const { return 0.5 * (span.min + span.max); }
};

/// The speed of a vehicle before its crash. One in the record is taken as right to 10 %, at least
/// to 2.5 mph where it is a multiple of 5 mph; one that is not there as a share of the speed limit.
///
/// @param role   what it did
/// @param whose  for the source: "ego's"
/// @return       nullopt: neither speed nor limit is known
[[nodiscard]] std::optional<RecordedSpeed> recorded_speed(const FarsVehicle& vehicle,
                                                          SpeedRole role, const FarsCodes& codes,
                                                          std::string_view whose);

}  // namespace saca::crash_records
