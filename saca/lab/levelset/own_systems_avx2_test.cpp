#include <gtest/gtest.h>

#include "saca/lab/levelset/own_systems.h"
#include "saca/thinking/danger/march_for_test.h"

namespace saca::levelset::own_systems_avx2_test {
namespace {

// Without inputs every point only moves along: V(x, tau) = h(x + rate x tau), by these loops too.
TEST(OwnSystemsAvx2, CarriesAStraightValueAlong) {
  if (!available(SimdLevel::avx2)) {
    GTEST_SKIP() << "this processor has no AVX2";
  }
  const danger::Grid grid = air3d_grid(13, 11, 8);
  const Air3d still{
      .evader_speed = 2.0, .pursuer_speed = 0.0, .evader_turn_rate = 0.0, .pursuer_turn_rate = 0.0};
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return x[0] - 40.0; }, 1);
  const auto values =
      danger::marched(grid, own_flow<double>(grid, still, Differences::weno5, SimdLevel::avx2), h,
                      1.0, {.tube = Tube::set});
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (danger::state_at(grid, i)[0] < 10.0) {  // the far edge bends what lies beyond it
      EXPECT_NEAR(values[i], h[i] - 2.0, 1e-4);
    }
  }
}

}  // namespace
}  // namespace saca::levelset::own_systems_avx2_test
