#if defined(__AVX512BW__)  // set for this file where the processor family has it

#include "saca/thinking/rollout/batch_kernel_of.h"

namespace saca::rollout::lanes {

Kernel kernel_avx512() noexcept {
  return kernel_of<xsimd::avx512bw>();
}

}  // namespace saca::rollout::lanes

#endif
