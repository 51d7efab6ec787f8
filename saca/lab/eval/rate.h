#pragma once

namespace saca::eval {

/// How often something happens per unit of exposure, with its exact two-sided 95 % interval.
struct Rate {
  int count = 0;
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Of a count that follows Poisson's law, over an exposure that is known exactly: events that come
/// independently of each other, at a rate that does not change.
///
/// low = chi2(0.025; 2 n) / 2 E (0 for n = 0), high = chi2(0.975; 2 n + 2) / 2 E, where chi2(p; k)
/// is the quantile of the chi-square law with k degrees of freedom. With nothing counted the upper
/// bound is -ln(0.025) / E = 3.689 / E; one-sided it would be -ln(0.05) / E, the rule of three.
///
/// @param count     >= 0
/// @param exposure  E, in the unit that the rate is per, > 0 and finite
/// @throws ContractViolation  if either is outside its range
/// Source: F. Garwood, Fiducial limits for the Poisson distribution, Biometrika 28 (1936), 437-442.
[[nodiscard]] Rate poisson_rate(int count, double exposure);

}  // namespace saca::eval
