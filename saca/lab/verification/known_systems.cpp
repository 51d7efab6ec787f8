#include "saca/lab/verification/known_systems.h"

#include "saca/lab/levelset/flow_of.h"

namespace saca::verification {

template <class Real, class System>
levelset::Flow<Real> known_flow(const danger::Grid& grid, const System& system,
                                levelset::Differences differences) {
  return levelset::flow_of<Real>(grid, system, differences);
}

template levelset::Flow<double> known_flow(const danger::Grid&, const ConstantMotion&,
                                           levelset::Differences);
template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<1>&,
                                           levelset::Differences);
template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<2>&,
                                           levelset::Differences);
template levelset::Flow<double> known_flow(const danger::Grid&, const AnyDirection<3>&,
                                           levelset::Differences);
template levelset::Flow<float> known_flow(const danger::Grid&, const AnyDirection<3>&,
                                          levelset::Differences);
template levelset::Flow<double> known_flow(const danger::Grid&, const DoubleIntegrator&,
                                           levelset::Differences);
template levelset::Flow<float> known_flow(const danger::Grid&, const DoubleIntegrator&,
                                          levelset::Differences);

}  // namespace saca::verification
