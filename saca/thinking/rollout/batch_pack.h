#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <xsimd/xsimd.hpp>

#include "saca/thinking/rollout/batch_lane.h"

/// A pack of floats as a number type of the equations (`core/number.h`), for one instruction set.
/// Every function works lane by lane with the same operations whatever stands in the others, so a
/// lane's bits do not depend on its neighbours. Only the kernels include this.
namespace saca::rollout::lanes {

template <class Arch>
struct Mask {
  xsimd::batch_bool<float, Arch> value;

  friend Mask operator&&(const Mask& a, const Mask& b) { return {a.value & b.value}; }
  friend Mask operator||(const Mask& a, const Mask& b) { return {a.value | b.value}; }
  friend Mask operator!(const Mask& a) { return {~a.value}; }
  friend bool any(const Mask& a) { return xsimd::any(a.value); }
  friend bool all(const Mask& a) { return xsimd::all(a.value); }
};

template <class Arch>
struct Product;

template <class Arch>
struct Pack {
  using Value = xsimd::batch<float, Arch>;
  static constexpr std::size_t size = Value::size;
  Value value;

  Pack() {}  // left as it is: an array of packs would else be filled with zeros first
  Pack(const Value& v) : value(v) {}
  Pack(double v) : value(static_cast<float>(v)) {}

  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  friend Pack operator-(const Pack& a) { return -a.value; }
  friend Pack operator+(const Pack& a, const Pack& b) { return a.value + b.value; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.value - b.value; }
  friend Product<Arch> operator*(const Pack& a, const Pack& b) { return {a, b}; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.value / b.value; }
  friend Product<Arch> operator/(const Pack& a, double b) { return {a, Pack(1.0 / b)}; }
  friend Mask<Arch> operator<(const Pack& a, const Pack& b) { return {a.value < b.value}; }
  friend Mask<Arch> operator>(const Pack& a, const Pack& b) { return {a.value > b.value}; }
  friend Mask<Arch> operator<=(const Pack& a, const Pack& b) { return {a.value <= b.value}; }
  friend Mask<Arch> operator>=(const Pack& a, const Pack& b) { return {a.value >= b.value}; }

  friend Pack select(const Mask<Arch>& mask, const Pack& a, const Pack& b) {
    return xsimd::select(mask.value, a.value, b.value);
  }
  friend Pack min(const Pack& a, const Pack& b) { return xsimd::min(a.value, b.value); }
  friend Pack max(const Pack& a, const Pack& b) { return xsimd::max(a.value, b.value); }
  friend Pack clamp(const Pack& a, const Pack& low, const Pack& high) {
    return min(max(a, low), high);
  }
  friend Pack abs(const Pack& a) { return xsimd::abs(a.value); }
  friend Pack sqrt(const Pack& a) { return xsimd::sqrt(a.value); }
  friend Pack round(const Pack& a) { return xsimd::nearbyint(a.value); }
  friend Pack hypot(const Pack& x, const Pack& y) { return sqrt(x * x + y * y); }
};

/// A product that knows its factors: what is added to it is added in one operation, where the
/// instruction set has one. Which sums are is a matter of the source, not of the compiler.
template <class Arch>
struct Product : Pack<Arch> {
  using Whole = Pack<Arch>;
  Whole a, b;

  Product(const Whole& x, const Whole& y) : Whole(x.value * y.value), a(x), b(y) {}

  friend Product operator-(const Product& p) { return {-p.a, p.b}; }
  friend Whole operator+(const Product& p, const Whole& c) {
    return xsimd::fma(p.a.value, p.b.value, c.value);
  }
  friend Whole operator+(const Whole& c, const Product& p) { return p + c; }
  friend Whole operator+(const Product& p, const Product& q) {
    return p + static_cast<const Whole&>(q);
  }
  friend Whole operator-(const Product& p, const Whole& c) {
    return xsimd::fms(p.a.value, p.b.value, c.value);
  }
  friend Whole operator-(const Whole& c, const Product& p) {
    return xsimd::fnma(p.a.value, p.b.value, c.value);
  }
  friend Whole operator-(const Product& p, const Product& q) {
    return p - static_cast<const Whole&>(q);
  }
};

template <class Arch>
inline Product<Arch> operator/(const Pack<Arch>& a, const Divisor<Pack<Arch>>& b) {
  return {a, b.inverse};
}

// Polynomials below: by interpolation at Chebyshev nodes, to the digits that a float holds.

// An angle within a quarter turn of zero, and whether sine and cosine there are those of `angle`
// (1) or their opposites (-1).
template <class Arch>
struct ReducedAngle {
  Pack<Arch> angle, sign;
};
template <class Arch>
inline ReducedAngle<Arch> reduced(const Pack<Arch>& angle) {
  // pi in two parts, the first of which is exact times any small number of half turns.
  constexpr double first = 3.140625;
  constexpr double second = std::numbers::pi - first;
  const Pack<Arch> half_turns = round(angle / std::numbers::pi);
  const Pack<Arch> odd = abs(half_turns - 2.0 * round(half_turns / 2.0));
  return {(angle - half_turns * first) - half_turns * second, 1.0 - 2.0 * odd};
}

/// Sine and cosine within a quarter turn of zero.
template <class Arch>
inline Pack<Arch> near_sin(const Pack<Arch>& angle) {
  constexpr std::array<double, 5> c{0.999999996, -0.166666579, 0.00833305017, -0.000198090174,
                                    2.60510764e-06};
  return angle * vehicle::equations::polynomial<Pack<Arch>>(c, angle * angle);
}
template <class Arch>
inline Pack<Arch> near_cos(const Pack<Arch>& angle) {
  constexpr std::array<double, 5> c{0.999999953, -0.499999048, 0.0416635732, -0.00138536295,
                                    2.31524167e-05};
  return vehicle::equations::polynomial<Pack<Arch>>(c, angle * angle);
}

template <class Arch>
inline Pack<Arch> sin(const Pack<Arch>& angle) {
  const ReducedAngle<Arch> r = reduced(angle);
  return r.sign * near_sin(r.angle);
}
template <class Arch>
inline Pack<Arch> cos(const Pack<Arch>& angle) {
  const ReducedAngle<Arch> r = reduced(angle);
  return r.sign * near_cos(r.angle);
}
/// @param angle  within a quarter turn of zero
template <class Arch>
inline Pack<Arch> tan(const Pack<Arch>& angle) {
  return near_sin(angle) / near_cos(angle);
}
/// @param value  in [-1, 1]
template <class Arch>
inline Pack<Arch> asin(const Pack<Arch>& value) {
  constexpr std::array<double, 6> c{0.999999996,  0.16666787,   0.0749453427,
                                    0.0455390097, 0.0239093636, 0.0425535991};  // to 1/2
  const Pack<Arch> size = abs(value);
  const auto large = size > 0.5;
  // asin(x) = pi/2 - 2 asin(sqrt((1 - x) / 2))
  const Pack<Arch> squared = select(large, 0.5 * (1.0 - size), size * size);
  const Pack<Arch> root = select(large, sqrt(max(0.0, squared)), size);
  const Pack<Arch> angle = root * vehicle::equations::polynomial<Pack<Arch>>(c, squared);
  const Pack<Arch> whole = select(large, 0.5 * std::numbers::pi - 2.0 * angle, angle);
  return select(value < 0.0, -whole, whole);
}
template <class Arch>
inline Pack<Arch> atan2(const Pack<Arch>& y, const Pack<Arch>& x);

}  // namespace saca::rollout::lanes

namespace saca::vehicle::equations {

template <class Arch>
struct MagicCurve<rollout::lanes::Pack<Arch>> {
  /// atan(w) / w over w^2 in [0, 1]: error 1e-7.
  static constexpr std::array<double, 8> arc{0.999999898,  -0.333319597,  0.199692354,
                                             -0.14016585,  0.099060969,   -0.0593671008,
                                             0.0241661895, -0.00466877331};
  /// sin(y) / y over y^2 in [0, pi^2]: error 6e-8.
  static constexpr std::array<double, 6> wave{0.999999937,     -0.166666207,   0.00833278847,
                                              -0.000198175451, 2.70873177e-06, -2.06941101e-08};
};

}  // namespace saca::vehicle::equations

namespace saca::rollout::lanes {

template <class Arch>
inline Pack<Arch> atan2(const Pack<Arch>& y, const Pack<Arch>& x) {
  using vehicle::equations::MagicCurve;
  const Pack<Arch> along = abs(x);
  const Pack<Arch> across = abs(y);
  const Pack<Arch> slope = min(along, across) / max(max(along, across), 1e-30);
  const Pack<Arch> acute = slope * vehicle::equations::polynomial<Pack<Arch>>(
                                       MagicCurve<Pack<Arch>>::arc, slope * slope);
  const Pack<Arch> first = select(across > along, 0.5 * std::numbers::pi - acute, acute);
  const Pack<Arch> half = select(x < 0.0, std::numbers::pi - first, first);
  return select(y < 0.0, -half, half);
}

}  // namespace saca::rollout::lanes
