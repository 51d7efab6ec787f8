#include "saca/base/world/cue.h"

#include <array>

#include "saca/base/core/names.h"

namespace saca::world {
namespace {

constexpr std::array<std::string_view, num_cue_kinds> cue_names{
    "school_zone",       "bus_at_stop", "parked_vans", "work_zone",
    "emergency_vehicle", "low_sun",     "wet_leaves"};

}  // namespace

std::string_view name(CueKind kind) {
  return name_of(kind, cue_names);
}
std::optional<CueKind> cue_kind_from(std::string_view name) {
  return value_from<CueKind>(name, cue_names);
}

}  // namespace saca::world
