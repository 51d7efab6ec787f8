#pragma once

#include <string>

#include "saca/base/world/road.h"
#include "saca/lab/report/picture_frame.h"

namespace saca::report {

/// The ground: road, lane markings, edges and what stands beyond them. Lanes beside the ego's are
/// taken to be as wide as it.
[[nodiscard]] std::string road_svg(const world::Road& road, const PictureFrame& frame);

}  // namespace saca::report
