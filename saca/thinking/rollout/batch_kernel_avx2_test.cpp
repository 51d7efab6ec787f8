#include "saca/thinking/rollout/batch_for_test.h"

namespace saca::rollout::batch_kernel_avx2_test {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnAvx2) {
  expect_stop_as_scalar(SimdLevel::avx2);
}

}  // namespace
}  // namespace saca::rollout::batch_kernel_avx2_test
