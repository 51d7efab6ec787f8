#include "saca/reach/own_systems.h"

#include "saca/core/contract.h"
#include "saca/reach/own_systems_kernel.h"

namespace saca::reach {

template <class Real, class System>
Flow<Real> own_flow(const Grid& grid, const System& system, Differences differences,
                    SimdLevel level) {
  expects(available(level), "the level is available");
#if defined(__x86_64__)
  if (level != SimdLevel::baseline) {
    return flow_of(grid, system, kernel_avx2<Real, System>(differences));
  }
#endif
  return flow_of<Real>(grid, system, differences);
}

template Flow<float> own_flow(const Grid&, const Air3d&, Differences, SimdLevel);
template Flow<double> own_flow(const Grid&, const Air3d&, Differences, SimdLevel);
template Flow<float> own_flow(const Grid&, const Avoidance&, Differences, SimdLevel);
template Flow<double> own_flow(const Grid&, const Avoidance&, Differences, SimdLevel);
template Flow<float> own_flow(const Grid&, const AvoidanceAhead&, Differences, SimdLevel);
template Flow<double> own_flow(const Grid&, const AvoidanceAhead&, Differences, SimdLevel);
template Flow<float> own_flow(const Grid&, const EdgeAvoidance&, Differences, SimdLevel);
template Flow<double> own_flow(const Grid&, const EdgeAvoidance&, Differences, SimdLevel);

}  // namespace saca::reach
