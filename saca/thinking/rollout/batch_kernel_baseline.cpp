#include "saca/thinking/rollout/batch_kernel_of.h"

namespace saca::rollout::lanes {

Kernel kernel_baseline() noexcept {
  return kernel_of<xsimd::default_arch>();
}

}  // namespace saca::rollout::lanes
