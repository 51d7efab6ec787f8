#include "saca/reach/known_systems.h"

#include "saca/reach/flow_of.h"

namespace saca::reach {

template <class Real, class System>
Flow<Real> known_flow(const Grid& grid, const System& system, Differences differences) {
  return flow_of<Real>(grid, system, differences);
}

template Flow<double> known_flow(const Grid&, const ConstantMotion&, Differences);
template Flow<double> known_flow(const Grid&, const AnyDirection<1>&, Differences);
template Flow<double> known_flow(const Grid&, const AnyDirection<2>&, Differences);
template Flow<double> known_flow(const Grid&, const AnyDirection<3>&, Differences);
template Flow<float> known_flow(const Grid&, const AnyDirection<3>&, Differences);
template Flow<double> known_flow(const Grid&, const DoubleIntegrator&, Differences);
template Flow<float> known_flow(const Grid&, const DoubleIntegrator&, Differences);

}  // namespace saca::reach
