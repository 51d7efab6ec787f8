#include "saca/onboard/manoeuvre/lane_shift.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "saca/onboard/manoeuvre/equations.h"

namespace saca::manoeuvre {
namespace {

// Rate at the end is start_v + A (first + ramp) - A (second + ramp): `second` follows from `first`.
// The offset at the end is then a parabola in `first`, known from three of its points.
std::optional<LaneShift> with_amplitude(const LaneShift& draft, double way, double amplitude) {
  LaneShift shift = draft;
  shift.amplitude = amplitude;
  const double longer = shift.start_v / amplitude;
  const double least = std::max(0.0, -longer);
  const auto beyond = [&](double first) {  // how far the shift ends past where it should
    shift.first = first;
    shift.second = first + longer;
    return (at(shift, duration(shift)).d - shift.start_d - way) / amplitude;
  };
  const double y0 = beyond(least);
  if (y0 > 0.0) {
    return std::nullopt;
  }
  const double y1 = beyond(least + 1.0);
  const double y2 = beyond(least + 2.0);
  const double bend = 0.5 * (y2 - 2.0 * y1 + y0);  // > 0: it is 1
  const double slope = y1 - y0 - bend;
  const double root = slope * slope - 4.0 * bend * y0;
  if (!(root >= 0.0)) {
    return std::nullopt;
  }
  const double more = (std::sqrt(root) - slope) / (2.0 * bend);
  shift.first = least + more;
  shift.second = shift.first + longer;
  return shift;
}

}  // namespace

double duration(const LaneShift& shift) noexcept {
  return 4.0 * shift.ramp + shift.first + shift.second;
}

Lateral at(const LaneShift& shift, double time) noexcept {
  const equations::Lateral<double> now = equations::at(shift, time);
  return {.d = now.d, .v = now.v, .a = now.a};
}

LaneShift lane_shift(double start_d, double start_v, double end_d, double amplitude,
                     double ramp) noexcept {
  const LaneShift draft{.start_d = start_d, .start_v = start_v, .ramp = ramp};
  if (start_v == 0.0 && end_d == start_d) {
    return {.start_d = end_d, .ramp = ramp};  // there already
  }
  // A rate that already carries too far needs the other side first. Shorter ways need less
  // acceleration: the same ramps then reach less high.
  double size = amplitude;
  for (int i = 0; i < 66; ++i, size *= 0.9) {  // down to a thousandth
    for (const double side : {1.0, -1.0}) {
      const double signed_size = std::copysign(size, side * (end_d - start_d));
      if (const auto shift = with_amplitude(draft, end_d - start_d, signed_size)) {
        return *shift;
      }
    }
  }
  return {.start_d = end_d, .ramp = ramp};  // as good as there
}

double largest_rate(const LaneShift& shift) noexcept {
  // The rate turns where the acceleration crosses zero: in the middle of the swing.
  return std::max(std::abs(shift.start_v), std::abs(at(shift, 2.0 * shift.ramp + shift.first).v));
}

}  // namespace saca::manoeuvre
