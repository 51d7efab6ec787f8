#include "saca/manoeuvre/batch_for_test.h"

namespace saca::manoeuvre::batch_kernel_baseline_test {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnBaseline) {
  expect_stop_as_scalar(SimdLevel::baseline);
}

}  // namespace
}  // namespace saca::manoeuvre::batch_kernel_baseline_test
