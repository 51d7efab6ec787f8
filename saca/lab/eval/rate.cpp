#include "saca/lab/eval/rate.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::eval {
namespace {

double half_chi_squared(double p, int degrees) {
  return 0.5 * boost::math::quantile(boost::math::chi_squared(degrees), p);
}

}  // namespace

Rate poisson_rate(int count, double exposure) {
  expects(count >= 0, "count >= 0");
  expects(exposure > 0.0 && std::isfinite(exposure), "exposure > 0 and finite");
  constexpr double tail = 0.025;
  return {.count = count,
          .value = count / exposure,
          .low = count == 0 ? 0.0 : half_chi_squared(tail, 2 * count) / exposure,
          .high = half_chi_squared(1.0 - tail, 2 * count + 2) / exposure};
}

}  // namespace saca::eval
