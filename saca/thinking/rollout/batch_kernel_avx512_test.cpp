#include "saca/thinking/rollout/batch_for_test.h"

namespace saca::rollout::batch_kernel_avx512_test {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnAvx512) {
  expect_stop_as_scalar(SimdLevel::avx512);
}

}  // namespace
}  // namespace saca::rollout::batch_kernel_avx512_test
