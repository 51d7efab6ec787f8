#pragma once

#include <span>
#include <string>
#include <vector>

#include "saca/base/world/track.h"
#include "saca/lab/report/picture_frame.h"

namespace saca::report {

/// One way in which a road user was thought to go on.
struct LikelyWay {
  double probability = 0.0;
  world::Track track;            ///< X_WA
  world::SpreadOverTime spread;  ///< about it
};

/// Ways as lines, the thicker and darker the likelier, and each second on them the ellipse that
/// holds half of what may be. Ways of less than 1 % are left out.
[[nodiscard]] std::string fan_svg(std::span<const LikelyWay> ways, const PictureFrame& frame);

}  // namespace saca::report
