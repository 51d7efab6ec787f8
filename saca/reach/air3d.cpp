#include "saca/reach/air3d.h"

#include <numbers>

namespace saca::reach {

Grid air3d_grid(int x_points, int y_points, int heading_points) {
  return {{{.name = "x", .first = -6.0, .last = 20.0, .points = x_points},
           {.name = "y", .first = -10.0, .last = 10.0, .points = y_points},
           {.name = "heading",
            .first = 0.0,
            .last = 2.0 * std::numbers::pi,
            .points = heading_points,
            .edge = Edge::periodic}}};
}

double intrusion(const Air3d& game, std::span<const double> state) {
  return game.capture_radius - std::hypot(state[0], state[1]);
}

}  // namespace saca::reach
