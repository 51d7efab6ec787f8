#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/recordings/pack.h"

namespace saca::importers {

/// What was made of one event of the release.
struct HundredCarOutcome {
  std::int64_t event = 0;
  std::string severity;  ///< "Crash" or "Near-Crash"; empty where the table has no line of it
  std::variant<HundredCarImport, HundredCarRefusal> made;

  /// nullptr: refused.
  [[nodiscard]] const HundredCarImport* rebuilt() const {
    return std::get_if<HundredCarImport>(&made);
  }
  /// nullptr: rebuilt.
  [[nodiscard]] const HundredCarRefusal* refusal() const {
    return std::get_if<HundredCarRefusal>(&made);
  }
};

/// Rebuilds every event whose rows lie in or below a folder (judged_hundred_car): the whole study,
/// or what a user has of it. Deterministic; an event takes some milliseconds.
///
/// @param folder    with the table of events and series (HundredCar_*.txt), one event's or many's
/// @param request   for each; its event and narrative are not used
/// @param progress  told after each file; may be empty
/// @return          each event once, by rising number; Error::Code::unreadable without folder or
///                  table, ::malformed without series, ::too_late when stopped
///
/// Rows that cannot be read refuse their event only, and so do rows of one event in two places that
/// differ; rows without a whole number in their first column are passed over.
[[nodiscard]] Result<std::vector<HundredCarOutcome>> import_hundred_cars(
    const std::filesystem::path& folder, const HundredCarRequest& request,
    const recordings::PackProgress& progress);

/// How many became a scenario.
[[nodiscard]] std::size_t num_rebuilt(const std::vector<HundredCarOutcome>& outcomes);

/// How many were refused, by reason; reasons that nobody had are left out.
[[nodiscard]] std::map<HundredCarReason, std::size_t> refusals(
    const std::vector<HundredCarOutcome>& outcomes);

}  // namespace saca::importers
