#pragma once

#include <array>
#include <cstddef>
#include <xsimd/xsimd.hpp>

namespace saca::levelset {

/// Neighbouring cells' numbers, worked on at once: the number type with which dynamics are called
/// (`flow.h`). Every function works cell by cell.
template <class Real, class Arch>
struct Pack {
  using Value = xsimd::batch<Real, Arch>;
  static constexpr std::size_t size = Value::size;
  Value value;

  Pack() = default;
  Pack(const Value& v) : value(v) {}               // NOLINT: a value is a pack
  Pack(double v) : value(static_cast<Real>(v)) {}  // NOLINT: so are as many equal ones
  static Pack load(const Real* from) { return Value::load_unaligned(from); }
  void store(Real* to) const { value.store_unaligned(to); }

  friend Pack operator-(const Pack& a) { return -a.value; }
  friend Pack operator+(const Pack& a, const Pack& b) { return a.value + b.value; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.value - b.value; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.value * b.value; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.value / b.value; }
  friend Pack min(const Pack& a, const Pack& b) { return xsimd::min(a.value, b.value); }
  friend Pack max(const Pack& a, const Pack& b) { return xsimd::max(a.value, b.value); }
  friend Pack abs(const Pack& a) { return xsimd::abs(a.value); }
  friend Pack sqrt(const Pack& a) { return xsimd::sqrt(a.value); }
  /// a b + c, rounded once where the instruction set does so.
  friend Pack fma(const Pack& a, const Pack& b, const Pack& c) {
    return xsimd::fma(a.value, b.value, c.value);
  }
  /// `a` where x < y, elsewhere `b`; both are computed.
  friend Pack where_less(const Pack& x, const Pack& y, const Pack& a, const Pack& b) {
    return xsimd::select(x.value < y.value, a.value, b.value);
  }
};

}  // namespace saca::levelset
