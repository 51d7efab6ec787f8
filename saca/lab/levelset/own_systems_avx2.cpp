#if defined(__AVX2__) && defined(__FMA__)  // set for this file where the processor family has it

#include "saca/lab/levelset/own_systems_kernel.h"

namespace saca::levelset {

template <class Real, class System>
Kernel<Real, System> kernel_avx2(Differences differences) {
  return kernel_of<Real, xsimd::fma3<xsimd::avx2>, System>(differences);
}

template Kernel<float, Air3d> kernel_avx2(Differences);
template Kernel<double, Air3d> kernel_avx2(Differences);
template Kernel<float, danger::Avoidance> kernel_avx2(Differences);
template Kernel<double, danger::Avoidance> kernel_avx2(Differences);
template Kernel<float, danger::AvoidanceAhead> kernel_avx2(Differences);
template Kernel<double, danger::AvoidanceAhead> kernel_avx2(Differences);
template Kernel<float, danger::EdgeAvoidance> kernel_avx2(Differences);
template Kernel<double, danger::EdgeAvoidance> kernel_avx2(Differences);

}  // namespace saca::levelset

#endif
