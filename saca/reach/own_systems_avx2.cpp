#if defined(__AVX2__) && defined(__FMA__)  // set for this file where the processor family has it

#include "saca/reach/own_systems_kernel.h"

namespace saca::reach {

template <class Real, class System>
Kernel<Real, System> kernel_avx2(Differences differences) {
  return kernel_of<Real, xsimd::fma3<xsimd::avx2>, System>(differences);
}

template Kernel<float, Air3d> kernel_avx2(Differences);
template Kernel<double, Air3d> kernel_avx2(Differences);
template Kernel<float, Avoidance> kernel_avx2(Differences);
template Kernel<double, Avoidance> kernel_avx2(Differences);
template Kernel<float, EdgeAvoidance> kernel_avx2(Differences);
template Kernel<double, EdgeAvoidance> kernel_avx2(Differences);

}  // namespace saca::reach

#endif
