#pragma once

#include "saca/base/world/footprint.h"
#include "saca/base/world/scene.h"

namespace saca::world {

struct UsualBody {
  Footprint footprint;  ///< about its centre
  double mass = 0.0;    ///< [kg]
};

/// A middle-sized body of each kind.
///
/// Car: the Global Vehicle Target's size and a compact car's mass; person: Euro NCAP's adult dummy,
/// 0.5 m wide; others: assumptions.
[[nodiscard]] UsualBody usual_body(ActorKind kind);

}  // namespace saca::world
