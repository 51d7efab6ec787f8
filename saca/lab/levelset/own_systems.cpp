#include "saca/lab/levelset/own_systems.h"

#include "saca/base/core/contract.h"
#include "saca/lab/levelset/own_systems_kernel.h"

namespace saca::levelset {

template <class Real, class System>
Flow<Real> own_flow(const danger::Grid& grid, const System& system, Differences differences,
                    SimdLevel level) {
  expects(available(level), "the level is available");
#if defined(__x86_64__)
  if (level != SimdLevel::baseline) {
    return flow_of(grid, system, kernel_avx2<Real, System>(differences));
  }
#endif
  return flow_of<Real>(grid, system, differences);
}

template Flow<float> own_flow(const danger::Grid&, const Air3d&, Differences, SimdLevel);
template Flow<double> own_flow(const danger::Grid&, const Air3d&, Differences, SimdLevel);
template Flow<float> own_flow(const danger::Grid&, const danger::Avoidance&, Differences,
                              SimdLevel);
template Flow<double> own_flow(const danger::Grid&, const danger::Avoidance&, Differences,
                               SimdLevel);
template Flow<float> own_flow(const danger::Grid&, const danger::AvoidanceAhead&, Differences,
                              SimdLevel);
template Flow<double> own_flow(const danger::Grid&, const danger::AvoidanceAhead&, Differences,
                               SimdLevel);
template Flow<float> own_flow(const danger::Grid&, const danger::EdgeAvoidance&, Differences,
                              SimdLevel);
template Flow<double> own_flow(const danger::Grid&, const danger::EdgeAvoidance&, Differences,
                               SimdLevel);

}  // namespace saca::levelset
