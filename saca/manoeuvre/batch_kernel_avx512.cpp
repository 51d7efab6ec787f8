#if defined(__x86_64__)

#include "saca/manoeuvre/batch_kernel_of.h"

namespace saca::manoeuvre::lanes {

Kernel kernel_avx512() noexcept {
  return kernel_of<xsimd::avx512bw>();
}

}  // namespace saca::manoeuvre::lanes

#endif
