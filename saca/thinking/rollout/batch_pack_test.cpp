#include "saca/thinking/rollout/batch_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace saca::rollout::lanes::batch_pack_test {
namespace {

using Arch = xsimd::default_arch;
using Numbers = Pack<Arch>;
using Lanes = std::array<float, Numbers::size>;

Numbers pack_of(const Lanes& lanes) {
  return Numbers(xsimd::load_unaligned<Arch>(lanes.data()));
}
Lanes lanes_of(const Numbers& pack) {
  Lanes lanes{};
  pack.value.store_unaligned(lanes.data());
  return lanes;
}
float first(const Numbers& pack) {
  return lanes_of(pack)[0];
}
bool holds(const Mask<Arch>& mask) {
  return first(select(mask, Numbers(1.0), Numbers(0.0))) == 1.0F;
}

// Largest difference of `ours` from `exact` over many values, in units of 2^-24: half the spacing
// of floats at 1. Relative to what is larger than 1.
template <class Ours, class Exact>
double worst(const Ours& ours, const Exact& exact, double low, double high) {
  constexpr int count = 4001;
  double largest = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(low + (high - low) * i / (count - 1));
    const double right = exact(static_cast<double>(x));
    const double found = static_cast<double>(first(ours(Numbers(static_cast<double>(x)))));
    largest = std::max(largest, std::abs(found - right) / std::max(1.0, std::abs(right)));
  }
  return largest * 0x1p24;
}

// The polynomials are good to 2 such units; the rest is what a few roundings sum up to.
constexpr double few_roundings = 8.0;

TEST(BatchPack, SineAndCosineAreExactToFloats) {
  const auto sine = [](const Numbers& x) { return Numbers(sin(x)); };
  const auto cosine = [](const Numbers& x) { return Numbers(cos(x)); };
  const auto exact_sine = [](double x) { return std::sin(x); };
  const auto exact_cosine = [](double x) { return std::cos(x); };
  EXPECT_LT(worst(sine, exact_sine, -7.0, 7.0), few_roundings);
  EXPECT_LT(worst(cosine, exact_cosine, -7.0, 7.0), few_roundings);
  // Many turns: the angle's own digits are lost in its reduction, here 2^-24 * 64.
  EXPECT_LT(worst(sine, exact_sine, -60.0, 60.0), few_roundings + 64.0);
  EXPECT_LT(worst(cosine, exact_cosine, -60.0, 60.0), few_roundings + 64.0);
}

TEST(BatchPack, TangentIsExactToFloats) {
  EXPECT_LT(worst([](const Numbers& x) { return tan(x); }, [](double x) { return std::tan(x); },
                  -1.3, 1.3),
            few_roundings);
}

TEST(BatchPack, ArcSineIsExactToFloatsUpToBothEnds) {
  EXPECT_LT(worst([](const Numbers& x) { return asin(x); }, [](double x) { return std::asin(x); },
                  -1.0, 1.0),
            few_roundings);
  EXPECT_NEAR(first(asin(Numbers(1.0))), 0.5 * std::numbers::pi, 2e-7);
  EXPECT_NEAR(first(asin(Numbers(-1.0))), -0.5 * std::numbers::pi, 2e-7);
}

TEST(BatchPack, ArcTangentKnowsAllQuarters) {
  for (const double size : {1e-6, 0.3, 1.0, 2.0e4}) {
    for (int i = -180; i <= 180; ++i) {
      const double angle = std::numbers::pi * i / 180.0;
      const auto x = static_cast<float>(size * std::cos(angle));
      const auto y = static_cast<float>(size * std::sin(angle));
      const double right = std::atan2(static_cast<double>(y), static_cast<double>(x));
      const double found =
          first(atan2(Numbers(static_cast<double>(y)), Numbers(static_cast<double>(x))));
      EXPECT_NEAR(found, right, 1e-6) << size << " " << i;
    }
  }
  EXPECT_EQ(first(atan2(Numbers(0.0), Numbers(0.0))), 0.0F);  // as std::atan2
  EXPECT_EQ(first(atan2(Numbers(0.0), Numbers(3.0))), 0.0F);
}

TEST(BatchPack, RootsLengthsAndRoundingAreTheirNamesakes) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<float> value(-50.0F, 50.0F);
  for (int i = 0; i < 200; ++i) {
    const float a = value(rng);
    const float b = value(rng);
    const Numbers x(static_cast<double>(a));
    const Numbers y(static_cast<double>(b));
    EXPECT_EQ(first(sqrt(abs(x))), std::sqrt(std::abs(a)));
    EXPECT_EQ(first(round(x)), std::nearbyint(a));
    EXPECT_FLOAT_EQ(first(hypot(x, y)), std::hypot(a, b));
    EXPECT_EQ(first(min(x, y)), std::min(a, b));
    EXPECT_EQ(first(max(x, y)), std::max(a, b));
    EXPECT_EQ(first(clamp(x, -10.0, 20.0)), std::clamp(a, -10.0F, 20.0F));
    EXPECT_EQ(first(x / y), a / b);
    EXPECT_EQ(first(-x), -a);
  }
  EXPECT_EQ(first(round(Numbers(2.5))), 2.0F);  // ties to even
  EXPECT_EQ(first(sqrt(Numbers(0.0))), 0.0F);
}

TEST(BatchPack, ComparisonsAndMasksAreThoseOfEachLane) {
  Lanes rising{};
  for (std::size_t i = 0; i < rising.size(); ++i) {
    rising[i] = static_cast<float>(i);
  }
  const Numbers x = pack_of(rising);
  const auto below = x < 2.0;
  const Lanes chosen = lanes_of(select(below, Numbers(1.0), x));
  for (std::size_t i = 0; i < rising.size(); ++i) {
    EXPECT_EQ(chosen[i], i < 2 ? 1.0F : rising[i]);
  }
  EXPECT_TRUE(any(below));
  EXPECT_FALSE(all(below));
  EXPECT_FALSE(any(below && x > 2.0));
  EXPECT_TRUE(all(below || x >= 2.0));
  EXPECT_TRUE(all(!(x < 0.0)));
  EXPECT_TRUE(holds(Numbers(2.0) <= 2.0));
  EXPECT_FALSE(holds(Numbers(2.0) < 2.0));
  EXPECT_TRUE(holds(Numbers(2.0) >= 2.0));
  EXPECT_FALSE(holds(Numbers(2.0) > 2.0));
  const Numbers nan(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(any(nan < 1.0));
  EXPECT_FALSE(any(nan >= 1.0));
}

TEST(BatchPack, SumsOfProductsAreThoseOfTheirFactors) {
  // Small whole numbers: exact, fused or not.
  const Numbers a(3.0);
  const Numbers b(5.0);
  const Numbers c(7.0);
  const Numbers d(11.0);
  EXPECT_EQ(first(a * b + c), 22.0F);
  EXPECT_EQ(first(c + a * b), 22.0F);
  EXPECT_EQ(first(a * b - c), 8.0F);
  EXPECT_EQ(first(c - a * b), -8.0F);
  EXPECT_EQ(first(-(a * b) + c), -8.0F);
  EXPECT_EQ(first(a * b + c * d), 92.0F);
  EXPECT_EQ(first(a * b - c * d), -62.0F);
  EXPECT_EQ(first(a * b * c), 105.0F);
  EXPECT_EQ(first(a * b), 15.0F);
  EXPECT_EQ(first(2.0 * a - 1.0), 5.0F);
  EXPECT_EQ(first(a / 2.0 + c), 8.5F);
  const Divisor<Numbers> half{Numbers(2.0), Numbers(0.5)};
  EXPECT_EQ(first(a / half), 1.5F);
  EXPECT_EQ(first(a / half - c), -5.5F);
  EXPECT_EQ(first(half * a), 6.0F);
}

TEST(BatchPack, NoLaneChangesItsNeighbours) {
  const auto all_of = [](const Numbers& x) {
    return Numbers(sin(x) + cos(x) * asin(clamp(x, -1.0, 1.0)) + atan2(x, 1.0 - x) + tan(0.1 * x));
  };
  Lanes lanes{};
  lanes.fill(0.3F);
  const float alone = first(all_of(pack_of(lanes)));
  for (const float other : {-5.0F, 0.0F, 0.9F, 1e20F, std::numeric_limits<float>::quiet_NaN()}) {
    std::fill(lanes.begin() + 1, lanes.end(), other);
    const float beside = first(all_of(pack_of(lanes)));
    EXPECT_EQ(std::memcmp(&alone, &beside, sizeof(alone)), 0) << other;
  }
}

}  // namespace
}  // namespace saca::rollout::lanes::batch_pack_test
