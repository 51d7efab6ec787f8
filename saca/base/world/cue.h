#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "saca/base/core/pose.h"

namespace saca::world {

/// What makes a place one where more has to be reckoned with than is seen.
enum class CueKind : std::uint8_t {
  school_zone,        ///< children may be about
  bus_at_stop,        ///< its doors are open
  parked_vans,        ///< a row of them, which nobody sees past
  work_zone,          ///< people work behind hoardings
  emergency_vehicle,  ///< its siren is heard from a side street; it is not seen
  low_sun,            ///< it blinds: who stands beside the road is seen late
  wet_leaves,         ///< on the road
};
constexpr std::size_t num_cue_kinds = 7;

/// All their names, for messages.
constexpr const char* cue_kind_words =
    "school_zone, bus_at_stop, parked_vans, work_zone, emergency_vehicle, low_sun or wet_leaves";

/// "bus_at_stop": as files and tables have it.
[[nodiscard]] std::string_view name(CueKind kind);
[[nodiscard]] std::optional<CueKind> cue_kind_from(std::string_view name);

/// One cue of a scene, as perception or a map tells it.
struct Cue {
  CueKind kind = CueKind::parked_vans;
  Vec2 p_W;  ///< where what it stands for would come from [m]

  bool operator==(const Cue&) const = default;
};

constexpr std::size_t max_cues = 4;

}  // namespace saca::world
