#pragma once

#include "saca/lab/levelset/flow.h"

/// One-sided differences along an axis of evenly spaced points, in units of the spacing.
namespace saca::levelset {

/// To the left and to the right of a cell.
template <class N>
struct Sides {
  N left, right;
};

/// How steep a value is along an axis at most, between neighbours: what scales weights.
template <class N>
struct Steepness {
  N inverse, sixth;
  Steepness() = default;
  explicit Steepness(double steepness) : inverse(1.0 / steepness), sixth(steepness / 6.0) {}
};

/// @param v  the cell's value and those of its three neighbours on either side   (7)
///
/// Source: Osher and Fedkiw, Level Set Methods and Dynamic Implicit Surfaces, 2003, chapter 3.
template <Differences differences, class N>
struct OneSided;

template <class N>
inline N less_in_size(const N& a, const N& b) {
  return where_less(abs(b), abs(a), b, a);
}

template <class N>
struct OneSided<Differences::upwind1, N> {
  static Sides<N> of(const std::array<N, 7>& v, const Steepness<N>& /*scale*/) {
    return {v[3] - v[2], v[4] - v[3]};
  }
};

template <class N>
struct OneSided<Differences::eno2, N> {
  static Sides<N> of(const std::array<N, 7>& v, const Steepness<N>& /*scale*/) {
    const N left = v[3] - v[2];
    const N right = v[4] - v[3];
    const N here = right - left;  // second differences at the cell and at its neighbours
    const N before = left - (v[2] - v[1]);
    const N after = (v[5] - v[4]) - right;
    return {left + 0.5 * less_in_size(before, here), right - 0.5 * less_in_size(here, after)};
  }
};

template <class N>
struct OneSided<Differences::eno3, N> {
  static Sides<N> of(const std::array<N, 7>& v, const Steepness<N>& /*scale*/) {
    std::array<N, 6> d;  // first, second and third differences, from left to right
    for (std::size_t k = 0; k < 6; ++k) {
      d[k] = v[k + 1] - v[k];
    }
    std::array<N, 5> e;
    for (std::size_t k = 0; k < 5; ++k) {
      e[k] = d[k + 1] - d[k];
    }
    std::array<N, 4> f;
    for (std::size_t k = 0; k < 4; ++k) {
      f[k] = e[k + 1] - e[k];
    }
    // The stencil grows to the side where the function is smoother, twice.
    const N outer_left = less_in_size(f[0], f[1]) / 3.0;
    const N middle_left = less_in_size(f[1], f[2]) / -6.0;
    const N outer_right = less_in_size(f[2], f[3]) / 3.0;
    const N left_to_left = where_less(abs(e[2]), abs(e[1]), middle_left, outer_left);
    const N right_to_left = where_less(abs(e[3]), abs(e[2]), outer_right, middle_left);
    return {d[2] + 0.5 * less_in_size(e[1], e[2]) + left_to_left,
            d[3] - 0.5 * less_in_size(e[2], e[3]) + right_to_left};
  }
};

/// Weights of Jiang and Peng (SIAM J. Sci. Comput. 21, 2000) with their three quotients brought
/// over one denominator. Differences are taken in units of `steepness`, so that the weights depend
/// neither on the values' scale nor on the precision's range.
template <class N>
struct OneSided<Differences::weno5, N> {
  static Sides<N> of(const std::array<N, 7>& v, const Steepness<N>& scale) {
    std::array<N, 6> d;
    for (std::size_t k = 0; k < 6; ++k) {
      d[k] = v[k + 1] - v[k];
    }
    std::array<N, 5> e;
    for (std::size_t k = 0; k < 5; ++k) {
      e[k] = (d[k + 1] - d[k]) * scale.inverse;
    }
    std::array<N, 4> bend;  // 13/12 of the squared third differences, and what keeps it from zero
    for (std::size_t k = 0; k < 4; ++k) {
      const N f = e[k + 1] - e[k];
      bend[k] = fma(f * (13.0 / 12.0), f, N(1e-6));
    }
    return {
        fma(correction({e[0], e[1], e[2], e[3]}, {bend[0], bend[1], bend[2]}), scale.sixth, d[2]),
        fma(correction({-e[4], -e[3], -e[2], -e[1]}, {bend[3], bend[2], bend[1]}), scale.sixth,
            d[3])};
  }

 private:
  static N squared(const N& a) { return a * a; }

  /// Six times what is added to the difference next to the cell.
  static N correction(const std::array<N, 4>& e, const std::array<N, 3>& bend) {
    const auto& [e0, e1, e2, e3] = e;
    const auto& [bend0, bend1, bend2] = bend;
    const N s0 = fma(squared(fma(e1, N(3.0), -e0)), N(0.25), bend0);
    const N s1 = fma(squared(e1 + e2), N(0.25), bend1);
    const N s2 = fma(squared(fma(e2, N(-3.0), e3)), N(0.25), bend2);
    const N w0 = squared(s1 * s2);
    const N w1 = squared(s0 * s2) * 6.0;
    const N w2 = squared(s0 * s1) * 3.0;
    const N sum = fma(w0, fma(e1, N(5.0), -2.0 * e0),
                      fma(w1, fma(e2, N(2.0), e1), w2 * fma(e2, N(4.0), -e3)));
    return sum / (w0 + w1 + w2);
  }
};

}  // namespace saca::levelset
