#include "saca/manoeuvre/batch_for_test.h"

namespace saca::manoeuvre {
namespace {

TEST(BatchKernel, StopsAsTheScalarModelOnBaseline) {
  expect_stop_as_scalar(Level::baseline);
}

}  // namespace
}  // namespace saca::manoeuvre
