#include "saca/base/core/direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace saca::direction_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double accuracy = 2.3e-16;

// Against the C library in extended precision, which is right to 1e-19.
void expect_right(double angle) {
  const auto [cosine, sine] = direction(angle);
  const auto exact = static_cast<long double>(angle);
  EXPECT_LT(std::abs(cosine - std::cos(exact)), accuracy) << angle;
  EXPECT_LT(std::abs(sine - std::sin(exact)), accuracy) << angle;
}

TEST(Direction, IsThatOfTheCLibrary) {
  std::mt19937_64 rng(1);
  for (const double most : {1e-9, 0.8, pi, 100.0, 1e4, 1e7}) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (int i = 0; i < 20000; ++i) {
      expect_right(angle(rng));
    }
  }
}

TEST(Direction, IsRightWhereQuartersMeet) {
  for (int eighth = -80; eighth <= 80; ++eighth) {
    const double angle = eighth * pi / 4.0;
    for (const double beside : {std::nextafter(angle, -1e9), angle, std::nextafter(angle, 1e9)}) {
      expect_right(beside);
    }
  }
}

// Where rounding decides everything: the double nearest to pi is 1.2246e-16 short of it.
TEST(Direction, KnowsHowFarADoubleIsFromPi) {
  EXPECT_NEAR(direction(pi).sine, 1.2246467991473532e-16, 1e-31);
  EXPECT_NEAR(direction(pi / 2.0).cosine, 6.123233995736766e-17, 1e-31);
}

TEST(Direction, MirrorImagesAreEqualToTheLastBit) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> angle(-20.0, 20.0);
  for (int i = 0; i < 20000; ++i) {
    const double a = angle(rng);
    EXPECT_EQ(direction(a).cosine, direction(-a).cosine) << a;
    EXPECT_EQ(direction(a).sine, -direction(-a).sine) << a;
  }
  EXPECT_EQ(direction(0.0).cosine, 1.0);
  EXPECT_EQ(direction(0.0).sine, 0.0);
}

TEST(Direction, OfNoNumberIsNoNumber) {
  for (const double angle :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(std::isnan(direction(angle).cosine));
    EXPECT_TRUE(std::isnan(direction(angle).sine));
  }
  EXPECT_NEAR(direction(std::numeric_limits<double>::max()).cosine,
              std::cos(std::numeric_limits<double>::max()), 0.0);
}

}  // namespace
}  // namespace saca::direction_test
