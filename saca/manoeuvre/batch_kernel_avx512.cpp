#if defined(__AVX512BW__)  // set for this file where the processor family has it

#include "saca/manoeuvre/batch_kernel_of.h"

namespace saca::manoeuvre::lanes {

Kernel kernel_avx512() noexcept {
  return kernel_of<xsimd::avx512bw>();
}

}  // namespace saca::manoeuvre::lanes

#endif
