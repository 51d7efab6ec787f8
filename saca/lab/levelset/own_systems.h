#pragma once

#include "saca/base/core/simd_level.h"
#include "saca/lab/levelset/air3d.h"
#include "saca/lab/levelset/flow_of.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/avoidance_ahead.h"

namespace saca::levelset {

/// One of this project's own systems, with inner loops for an instruction set of this machine.
///
/// @tparam System  Air3d, Avoidance, AvoidanceAhead or EdgeAvoidance
/// @param level    available; avx512 takes the loops of avx2. Results of two levels differ by
///                 rounding
/// @throws ContractViolation  as `flow_of` (`flow_of.h`)
template <class Real, class System>
[[nodiscard]] Flow<Real> own_flow(const danger::Grid& grid, const System& system,
                                  Differences differences = Differences::weno5,
                                  SimdLevel level = best_level());

extern template Flow<float> own_flow(const danger::Grid&, const Air3d&, Differences, SimdLevel);
extern template Flow<double> own_flow(const danger::Grid&, const Air3d&, Differences, SimdLevel);
extern template Flow<float> own_flow(const danger::Grid&, const danger::Avoidance&, Differences,
                                     SimdLevel);
extern template Flow<double> own_flow(const danger::Grid&, const danger::Avoidance&, Differences,
                                      SimdLevel);
extern template Flow<float> own_flow(const danger::Grid&, const danger::AvoidanceAhead&,
                                     Differences, SimdLevel);
extern template Flow<double> own_flow(const danger::Grid&, const danger::AvoidanceAhead&,
                                      Differences, SimdLevel);
extern template Flow<float> own_flow(const danger::Grid&, const danger::EdgeAvoidance&, Differences,
                                     SimdLevel);
extern template Flow<double> own_flow(const danger::Grid&, const danger::EdgeAvoidance&,
                                      Differences, SimdLevel);

}  // namespace saca::levelset
