#if defined(__AVX2__) && defined(__FMA__)  // set for this file where the processor family has it

#include "saca/thinking/rollout/batch_kernel_of.h"

namespace saca::rollout::lanes {

Kernel kernel_avx2() noexcept {
  return kernel_of<xsimd::fma3<xsimd::avx2>>();
}

}  // namespace saca::rollout::lanes

#endif
