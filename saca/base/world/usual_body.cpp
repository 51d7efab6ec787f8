#include "saca/base/world/usual_body.h"

#include <array>
#include <cstddef>

namespace saca::world {
namespace {

UsualBody box(double length, double width, double mass) {
  return {{.shape = Shape::box, .length = length, .width = width}, mass};
}

}  // namespace

UsualBody usual_body(ActorKind kind) {
  switch (kind) {
    case ActorKind::car:
      return box(4.02, 1.71, 1400.0);
    case ActorKind::van:
      return box(5.5, 2.0, 2300.0);
    case ActorKind::truck:
      return box(8.0, 2.5, 12000.0);
    case ActorKind::motorcycle:
      return box(2.1, 0.8, 260.0);
    case ActorKind::bicycle:
      return box(1.8, 0.5, 90.0);
    case ActorKind::pedestrian:
      return {{.shape = Shape::ellipse, .length = 0.6, .width = 0.5}, 75.0};
    case ActorKind::obstacle:
      break;
  }
  return box(2.0, 2.0, 1000.0);
}

}  // namespace saca::world
