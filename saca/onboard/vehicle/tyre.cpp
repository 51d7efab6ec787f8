#include "saca/onboard/vehicle/tyre.h"

namespace saca::vehicle {
double force_share(const Tyre& tyre, double peak, double slip) {
  const double z = equations::steepness(tyre, peak) * slip;
  return z * magic_ratio(tyre.shape, z * z);
}

double slip_for(const Tyre& tyre, double peak, double share) {
  return equations::slip_for(tyre, peak, share);
}

}  // namespace saca::vehicle
