#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "saca/base/config/config.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::scenario {

// How bodies move, as a scenario file says it. What is wrong is rejected in the table, as
// everywhere in `config`; what is returned then is harmless.

/// What a scenario may say: wide enough for every road, narrow enough to catch a slip.
constexpr config::Range position_range{-1e5, 1e5};     // [m]
constexpr config::Range heading_range{-180.0, 180.0};  // [deg]
constexpr config::Range speed_range{0.0, 100.0};       // [m/s]
constexpr config::Range time_range{0.0, 600.0};        // [s]

/// Degrees under `key`, as radians.
[[nodiscard]] double read_angle(config::Table& table, std::string_view key);

/// The value that stands under `key` as a word; the first one when the word is not known.
template <class Enum>
Enum read_word(config::Table& table, std::string_view key,
               std::optional<Enum> (*from)(std::string_view), std::string_view wanted) {
  const std::string got = table.text(key);
  const std::optional<Enum> value = from(got);
  if (!value) {
    table.reject(key, "want " + std::string(wanted) + ", got \"" + got + "\"");
  }
  return value.value_or(Enum{});
}

/// A pose along the road; a reader of messages finds s and d rather than x and y.
[[nodiscard]] world::LanePose read_lane_pose(config::Table& table);

/// The one of two tables that says how a body moves.
[[nodiscard]] bool is_recorded(config::Table& table);

/// Of a road user: without yaw rates, which stay 0.
[[nodiscard]] Recording read_recording(config::Table table);
/// Of the ego: with what its gyro measured, `yaw_rate_degps`.
[[nodiscard]] Recording read_ego_recording(config::Table table);

/// @param kind  of the actor: who walks, and who drives behind others
[[nodiscard]] Script read_script(config::Table table, world::ActorKind kind);

}  // namespace saca::scenario
