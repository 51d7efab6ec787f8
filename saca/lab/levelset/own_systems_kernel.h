#pragma once

#include "saca/lab/levelset/air3d.h"
#include "saca/lab/levelset/sweep.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/avoidance_ahead.h"

/// Inner loops of the project's own systems by instruction set. Not part of the library's
/// interface.
namespace saca::levelset {

template <class Real, class System>
[[nodiscard]] Kernel<Real, System> kernel_avx2(Differences differences);

}  // namespace saca::levelset
