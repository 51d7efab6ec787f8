#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "saca/lab/crash_records/fars.h"
#include "saca/lab/crash_records/fars_codes.h"
#include "saca/lab/families/family.h"
#include "saca/onboard/collision/face.h"

namespace saca::crash_records {

/// What kind of crash a record tells of; all but `ramp` by its crash type (ACC_TYPE).
enum class CrashFamily : std::uint8_t {
  rear_end,     ///< the ego strikes who is ahead and stands, is slower or slows down
  lane_change,  ///< somebody beside changes into the ego's lane
  head_on,      ///< somebody comes over into the ego's lane from the opposite direction
  crossing,     ///< straight paths cross
  turning,      ///< somebody turns across the ego's path, or into it
  pedestrian,
  cyclist,
  ramp,  ///< any of these on a ramp or beside one
};
constexpr std::size_t num_crash_families = 8;
[[nodiscard]] std::string_view name(CrashFamily family);
[[nodiscard]] std::optional<CrashFamily> crash_family_from(std::string_view name);

/// Where it was: on a ramp (VTRAFWAY 6, RELJCT2 5, 17, 20); at a junction or driveway (RELJCT2 2,
/// 3, 4, 8; where that is not known, by a crash type of one); else by the speed limit: from 55 mph
/// on a highway; else a road.
enum class Place : std::uint8_t { ramp, junction, highway, road };
[[nodiscard]] std::string_view name(Place place);

/// Who takes which part when a record is played: the ego is the car that might have avoided it.
struct Roles {
  CrashFamily family = CrashFamily::rear_end;
  Place place = Place::road;
  families::FamilyKind kind = families::FamilyKind::slower_lead;
  std::size_t ego = 0;                    ///< index into FarsCrash::vehicles
  std::optional<std::size_t> other;       ///< likewise
  std::optional<std::size_t> person;      ///< index into FarsCrash::persons
  std::optional<bool> from_left;          ///< from where the other comes into the ego's lane
  std::optional<collision::Face> struck;  ///< which side of the ego, by the crash type
};

/// Why no encounter is made of a record.
enum class NoRoles : std::uint8_t {
  type_not_covered,  ///< no crash type of these: one vehicle alone, backing, unknown
  ego_is_no_car,     ///< the one that might have avoided it is a motorcycle, truck or unknown body
  other_unknown,     ///< nobody of the other type of the pair is in the record, or what it is
};
[[nodiscard]] std::string_view name(NoRoles why);

[[nodiscard]] std::variant<Roles, NoRoles> roles_of(const FarsCrash& crash, const FarsCodes& codes);

/// The family of a crash, whether or not an encounter can be made of it; nullopt: none.
[[nodiscard]] std::optional<CrashFamily> crash_family_of(const FarsCrash& crash);

/// The side of a vehicle that was hit first (IMPACT1); nullopt: none of the four, or not known.
[[nodiscard]] std::optional<collision::Face> face_of_impact(const Code& impact);

}  // namespace saca::crash_records
