#include "saca/manoeuvre/batch_kernel_of.h"

namespace saca::manoeuvre::lanes {

Kernel kernel_baseline() noexcept {
  return kernel_of<xsimd::default_arch>();
}

}  // namespace saca::manoeuvre::lanes
