#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::config {

// One number of a TOML text, under a path of keys and of places in lists, from 0, with dots between
// them: "road.lane_width_m", "actors.0.start.speed_mps", "ego.recording.speed_mps.12".

/// nullopt: no number stands there, or the text is no TOML.
[[nodiscard]] std::optional<double> number_at(std::string_view text, std::string_view path);

/// The text with this number there, instead of that which was. Tables and a last key that are not
/// there are made; places in lists are not. Comments are lost, no other value is changed.
/// @return  Error::Code::malformed where the path leads through what is neither, or the text is no
///          TOML
[[nodiscard]] Result<std::string> with_number(std::string_view text, std::string_view path,
                                              double value);

}  // namespace saca::config
