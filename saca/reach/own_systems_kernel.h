#pragma once

#include "saca/reach/air3d.h"
#include "saca/reach/avoidance.h"
#include "saca/reach/sweep.h"

/// Inner loops of the project's own systems by instruction set. Not part of the library's
/// interface.
namespace saca::reach {

template <class Real, class System>
[[nodiscard]] Kernel<Real, System> kernel_avx2(Differences differences);

}  // namespace saca::reach
