#include "saca/onboard/collision/false_position.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saca::collision::false_position_test {
namespace {

TEST(FalsePosition, FindsTheLastTimeBeforeAZero) {
  const auto check = [](const auto& value, double before, double after, double zero) {
    int calls = 0;
    const double found =
        last_positive({before, value(before), after, value(after)}, 1e-9, 0.0, [&](double time) {
          ++calls;
          return value(time);
        });
    EXPECT_GT(value(found), 0.0);
    EXPECT_NEAR(found, zero, 5e-6);  // the sharp bend needs all calls that there are
    EXPECT_LE(calls, 60);
  };
  check([](double t) { return 1.0 - t; }, 0.0, 3.0, 1.0);
  check([](double t) { return 2.0 - t * t; }, 0.0, 3.0, std::sqrt(2.0));
  check([](double t) { return std::exp(-t) - 0.5; }, 0.0, 30.0, std::log(2.0));
  check([](double t) { return t < 0.7 ? 0.7 - t : 100.0 * (0.7 - t); }, 0.0, 1.0, 0.7);
}

TEST(FalsePosition, StopsWhereLittleIsLeft) {
  const auto value = [](double t) { return 1.0 - t * t; };
  const double found = last_positive({0.0, 1.0, 5.0, -24.0}, 0.0, 1e-3, value);
  EXPECT_GT(value(found), 0.0);
  EXPECT_LE(value(found), 1e-3);
}

}  // namespace
}  // namespace saca::collision::false_position_test
