#pragma once

#include "saca/core/simd_level.h"
#include "saca/reach/air3d.h"
#include "saca/reach/avoidance.h"
#include "saca/reach/avoidance_ahead.h"
#include "saca/reach/flow_of.h"

namespace saca::reach {

/// One of this project's own systems, with inner loops for an instruction set of this machine.
///
/// @tparam System  Air3d, Avoidance, AvoidanceAhead or EdgeAvoidance
/// @param level    available; avx512 takes the loops of avx2. Results of two levels differ by
///                 rounding
/// @throws ContractViolation  as `flow_of` (`flow_of.h`)
template <class Real, class System>
[[nodiscard]] Flow<Real> own_flow(const Grid& grid, const System& system,
                                  Differences differences = Differences::weno5,
                                  SimdLevel level = best_level());

extern template Flow<float> own_flow(const Grid&, const Air3d&, Differences, SimdLevel);
extern template Flow<double> own_flow(const Grid&, const Air3d&, Differences, SimdLevel);
extern template Flow<float> own_flow(const Grid&, const Avoidance&, Differences, SimdLevel);
extern template Flow<double> own_flow(const Grid&, const Avoidance&, Differences, SimdLevel);
extern template Flow<float> own_flow(const Grid&, const AvoidanceAhead&, Differences, SimdLevel);
extern template Flow<double> own_flow(const Grid&, const AvoidanceAhead&, Differences, SimdLevel);
extern template Flow<float> own_flow(const Grid&, const EdgeAvoidance&, Differences, SimdLevel);
extern template Flow<double> own_flow(const Grid&, const EdgeAvoidance&, Differences, SimdLevel);

}  // namespace saca::reach
