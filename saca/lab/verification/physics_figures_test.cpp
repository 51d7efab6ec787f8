#include "saca/lab/verification/physics_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::verification::physics_figures_test {
namespace {

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = physics_figures(prepare::default_car());
  return all;
}

TEST(PhysicsFigures, AllLieInTheirBands) {
  for (const Figure& figure : figures()) {
    EXPECT_TRUE(in_band(figure)) << figure.name << " = " << figure.value << ", want " << figure.low
                                 << " to " << figure.high;
  }
}

TEST(PhysicsFigures, HaveDifferentNames) {
  std::set<std::string> names;
  for (const Figure& figure : figures()) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
  }
  EXPECT_THAT(names, testing::Contains("physics.aeb.stop_distance_m.v14.mu0.9"));
}

TEST(PhysicsFigures, RefuseWhatIsNoStop) {
  const auto car = prepare::default_car();
  EXPECT_THROW((void)stop_straight(car, Abs::ideal, 0.0, 0.9), ContractViolation);
  EXPECT_THROW((void)stop_straight(car, Abs::ideal, 14.0, 0.1), ContractViolation);
}

}  // namespace
}  // namespace saca::verification::physics_figures_test
