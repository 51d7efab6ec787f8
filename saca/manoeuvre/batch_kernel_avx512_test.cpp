#include "saca/manoeuvre/batch_for_test.h"

namespace saca::manoeuvre {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnAvx512) {
  expect_stop_as_scalar(Level::avx512);
}

}  // namespace
}  // namespace saca::manoeuvre
