#include "saca/lab/crash_records/recorded_speed.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/base/core/units.h"

namespace saca::crash_records {

std::optional<RecordedSpeed> recorded_speed(const FarsVehicle& vehicle, SpeedRole role,
                                            const FarsCodes& codes, std::string_view whose) {
  if (vehicle.travel_speed) {
    const double mph = *vehicle.travel_speed;
    const bool rounded = *vehicle.travel_speed % 5 == 0;
    const double half = std::max(0.1 * mph, rounded ? 2.5 : 0.5);
    return RecordedSpeed{
        .span = {from_mph(std::max(0.0, mph - half)), from_mph(mph + half)},
        .recorded = true,
        .source = fmt::format("{}{} TRAV_SP {} mph; taken as right to {:.1f} mph", recorded_prefix,
                              whose, *vehicle.travel_speed, half)};
  }
  if (vehicle.speed_limit) {
    const Span share = codes.speed_over_limit(role);
    const double limit = from_mph(*vehicle.speed_limit);
    return RecordedSpeed{
        .span = {share.min * limit, share.max * limit},
        .recorded = false,
        .source = fmt::format("assumption: {} TRAV_SP is not known; {:.2f} to {:.2f} of VSPD_LIM "
                              "{} mph, as others who went {}",
                              whose, share.min, share.max, *vehicle.speed_limit, name(role))};
  }
  return std::nullopt;
}

}  // namespace saca::crash_records
