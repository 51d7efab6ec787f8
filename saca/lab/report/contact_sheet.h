#pragma once

#include <string>
#include <vector>

#include "saca/lab/report/scene_svg.h"

namespace saca::report {

/// Many scenes beside each other.
struct ContactSheet {
  std::string heading;
  std::vector<std::string> lines;  ///< below it
  std::vector<SceneView> scenes;   ///< in reading order
  /// All show the same ground to the same scale: for several manoeuvres in one scene.
  bool same_ground = false;
  int columns = 4;  ///< at most, >= 1
  SvgSize thumbnail{300.0, 215.0};
};

/// One file: heading, the scenes row by row, and what the colours mean.
/// @throws ContractViolation  if there is no scene, or as `scene_svg` does
[[nodiscard]] std::string contact_sheet(const ContactSheet& sheet);

}  // namespace saca::report
