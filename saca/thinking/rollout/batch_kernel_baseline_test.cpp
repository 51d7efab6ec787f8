#include "saca/thinking/rollout/batch_for_test.h"

namespace saca::rollout::batch_kernel_baseline_test {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnBaseline) {
  expect_stop_as_scalar(SimdLevel::baseline);
}

}  // namespace
}  // namespace saca::rollout::batch_kernel_baseline_test
