#pragma once

#include <array>
#include <cstdint>

#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::atlas {

/// Changed by hand when the atlas' own meaning changes, or the batch's scheme (`behaviour` knows
/// the scalar model only), so that older files are refused.
constexpr std::uint32_t atlas_version = 4;

/// Names a car's parameters and tuning; with others nothing tabled is true.
[[nodiscard]] std::uint64_t car_hash(const manoeuvre::Car& car);

/// Names a grid.
[[nodiscard]] std::uint64_t grid_hash(const AtlasGrid& grid);

/// Where a few short manoeuvres of every kind end, and stops with half of the grip: x, y [m],
/// heading [rad], time [s] of each. When
/// vehicle model or controllers change, so does this, whoever forgets to say so.
using Behaviour = std::array<double, (num_atlas_kinds + 1) * 2 * 4>;
[[nodiscard]] Behaviour behaviour(const manoeuvre::Car& car);

/// Do two cars or programs drive alike: all within a millimetre, milliradian, millisecond or two
/// (instruction sets differ in the last digits)?
[[nodiscard]] bool alike(const Behaviour& a, const Behaviour& b);

}  // namespace saca::atlas
