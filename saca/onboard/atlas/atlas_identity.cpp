#include "saca/onboard/atlas/atlas_identity.h"

#include <bit>
#include <cmath>
#include <cstddef>

#include "saca/base/core/fnv.h"
#include "saca/onboard/atlas/atlas_point.h"
#include "saca/onboard/manoeuvre/drive.h"

namespace saca::atlas {

std::uint64_t car_hash(const manoeuvre::Car& car) {
  Fnv hash;
  hash.add_doubles(static_cast<const vehicle::Vehicle&>(car));
  hash.add_doubles(car.tuning.swerve);
  hash.add_doubles(car.tuning.drift);
  hash.add_doubles(car.tuning.domain);
  return hash.value();
}

std::uint64_t grid_hash(const AtlasGrid& grid) {
  Fnv hash;
  for (const AtlasAxes& axes : grid) {
    for (const AtlasAxes::Axis* axis : {&axes.speeds, &axes.grips, &axes.ways, &axes.shares}) {
      hash.add(axis->size());
      for (const double value : *axis) {
        hash.add(std::bit_cast<std::uint64_t>(value));
      }
    }
  }
  return hash.value();
}

Behaviour behaviour(const manoeuvre::Car& car) {
  constexpr double a_while = 1.5;  // [s] of what does not stop
  const manoeuvre::Car driven = unbounded(car);
  Behaviour all{};
  auto out = all.begin();
  for (std::size_t i = 0; i <= num_atlas_kinds; ++i) {
    const auto kind = i < num_atlas_kinds ? static_cast<AtlasKind>(i) : AtlasKind::stop;
    const bool in_full = i == static_cast<std::size_t>(AtlasKind::stop);
    const bool turns = kind >= AtlasKind::swerve && kind != AtlasKind::drift;
    for (const double speed : {9.0, 15.0}) {
      const AtlasPoint point{kind, speed, 0.8, turns ? 3.4 : 0.0, in_full ? 1.0 : 0.5};
      const double longest = ends_at_rest(point.kind) ? longest_stop : a_while;
      const AtlasTrace trace = trace_of(
          manoeuvre::drive(driven, plan_of(point), scene_of(car, point), 0.9 * point.grip, longest),
          longest);
      const auto last = trace.look.back();
      for (const double number : {last[0], last[1], last[2], trace.end}) {
        *out++ = number;
      }
    }
  }
  return all;
}

bool alike(const Behaviour& a, const Behaviour& b) {
  constexpr double tolerance = 1.5e-3;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) <= tolerance)) {
      return false;
    }
  }
  return true;
}

}  // namespace saca::atlas
