#include "saca/vehicle/tyre.h"

namespace saca::vehicle {
namespace {

// B of the magic formula: the slope at zero, B C D, is stiffness * load whatever the friction.
double steepness(const Tyre& tyre, double peak) {
  return tyre.stiffness / (tyre.shape * peak);
}

}  // namespace

double force_share(const Tyre& tyre, double peak, double slip) {
  const double z = steepness(tyre, peak) * slip;
  return z * magic_ratio(tyre.shape, z * z);
}

double slip_for(const Tyre& tyre, double peak, double share) {
  return std::tan(std::asin(share) / tyre.shape) / steepness(tyre, peak);
}

}  // namespace saca::vehicle
