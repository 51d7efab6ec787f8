#if defined(__AVX2__) && defined(__FMA__)  // set for this file where the processor family has it

#include "saca/manoeuvre/batch_kernel_of.h"

namespace saca::manoeuvre::lanes {

Kernel kernel_avx2() noexcept {
  return kernel_of<xsimd::fma3<xsimd::avx2>>();
}

}  // namespace saca::manoeuvre::lanes

#endif
