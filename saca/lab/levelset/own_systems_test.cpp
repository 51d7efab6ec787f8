#include "saca/lab/levelset/own_systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/thinking/danger/march_for_test.h"
#include "tests/support/levels.h"

namespace saca::levelset::own_systems_test {
namespace {

/// Values after a short march, in doubles.
template <class System>
std::vector<double> soon(const danger::Grid& grid, const System& system, Differences differences,
                         SimdLevel level) {
  const auto h = danger::sampled<double>(
      grid, [](auto x) { return 3.0 - std::hypot(x[0], 0.7 * x[1]); }, 1);
  return danger::marched(grid, own_flow<double>(grid, system, differences, level), h, 0.2);
}

template <class System>
void expect_levels_agree(const danger::Grid& grid, const System& system) {
  for (const Differences differences :
       {Differences::upwind1, Differences::eno2, Differences::eno3, Differences::weno5}) {
    const auto plain = soon(grid, system, differences, SimdLevel::baseline);
    const auto wide = soon(grid, system, differences, best_level());
    ASSERT_EQ(plain.size(), wide.size());
    // ENO chooses between stencils, which a rounding may turn over where they are alike.
    const bool chooses = differences == Differences::eno2 || differences == Differences::eno3;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      ASSERT_NEAR(plain[i], wide[i], chooses ? 1e-3 : 1e-9);
    }
  }
}

TEST(OwnFlow, IsTheSameOnEachInstructionSet) {
  const double pi = std::numbers::pi;
  expect_levels_agree(air3d_grid(27, 21, 12), Air3d{});
  const danger::Axis course{
      .name = "course", .first = -pi, .last = pi, .points = 12, .edge = danger::Edge::periodic};
  const danger::Axis speed{.name = "speed", .first = 0.0, .last = 20.0, .points = 6};
  expect_levels_agree({{{.name = "x", .first = -20.0, .last = 10.0, .points = 17},
                        {.name = "y",
                         .first = 0.0,
                         .last = 10.0,
                         .points = 8,
                         .edge = danger::Edge::mirrored,
                         .turned = 2},
                        course,
                        speed}},
                      danger::Avoidance{.obstacle_speed = 4.0});
  expect_levels_agree({{{.name = "ahead", .first = -10.0, .last = 20.0, .points = 17},
                        {.name = "left", .first = -10.0, .last = 10.0, .points = 8},
                        course,
                        speed}},
                      danger::AvoidanceAhead{{.obstacle_speed = 4.0}});
  expect_levels_agree({{{.name = "y", .first = -20.0, .last = 10.0, .points = 17}, course, speed}},
                      danger::EdgeAvoidance{});
}

/// Whether a first step of `h` is refused.
template <class Real>
bool refused(const danger::Grid& grid, const Flow<Real>& flow, const std::vector<Real>& h,
             Tube tube) {
  return !Solver<Real>(grid, flow, h, {.tube = tube}).step(0.01).has_value();
}

template <class Real>
void expect_nan_found(SimdLevel level, Tube tube) {
  const danger::Grid grid = air3d_grid(9, 8, 6);
  Flow<Real> flow =
      own_flow<Real>(grid, Air3d{.pursuer_turn_rate = std::nan("")}, Differences::weno5, level);
  flow.crossings_per_second = 1.0;  // which are no number either
  const auto h = danger::sampled<Real>(
      grid, [](auto x) { return 3.0 - std::hypot(x[0], 0.7 * x[1]); }, 1);
  EXPECT_TRUE(refused(grid, flow, h, tube));
}

TEST(OwnFlow, FindsWhatIsNoNumberOnEachInstructionSet) {
  for (const SimdLevel level : test::those_here({SimdLevel::baseline, SimdLevel::avx2})) {
    for (const Tube tube : {Tube::set, Tube::tube, Tube::highest}) {
      SCOPED_TRACE(testing::Message()
                   << test::name_of(level) << ", tube " << static_cast<int>(tube));
      expect_nan_found<float>(level, tube);
      expect_nan_found<double>(level, tube);
    }
  }
}

TEST(OwnFlow, RefusesAGridOfOtherDimensions) {
  EXPECT_THROW((void)own_flow<float>(air3d_grid(10, 10, 10), danger::Avoidance{}),
               ContractViolation);
}

}  // namespace
}  // namespace saca::levelset::own_systems_test
