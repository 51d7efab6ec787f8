#include "saca/learn/motion_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "saca/core/contract.h"
#include "saca/learn/sequences_for_test.h"

namespace saca::learn {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double tenth = 0.1;

std::vector<std::uint8_t> letters(std::string_view text) {
  return labelled(text).labels;
}

std::vector<std::uint8_t> lateral(const std::vector<double>& lateral_speed) {
  return motion_labels(std::vector<double>(lateral_speed.size(), 0.0), lateral_speed, tenth).labels;
}

MotionLabels braking(const std::vector<double>& acceleration) {
  return motion_labels(acceleration, std::vector<double>(acceleration.size(), 0.0), tenth);
}

TEST(MotionLabels, ALaneChangeBeginsAboveOneSpeedAndEndsBelowTheOther) {
  // 0.3 m/s belongs to the motion at its begin, but counts only at its end. 1.2 m in all.
  EXPECT_EQ(lateral({0.1, 0.3, 3.0, 3.0, 3.0, 2.4, 0.3, 0.19, 0.0}), letters("MMLLLLLMM"));
}

TEST(MotionLabels, AShortWayIsNoLaneChange) {
  EXPECT_EQ(lateral({3.0, 3.0, 3.0, 0.9, 0.0}), letters("MMMMM"));   // 0.99 m
  EXPECT_EQ(lateral({3.0, 3.0, 3.0, 1.01, 0.0}), letters("LLLLM"));  // 1.001 m
}

TEST(MotionLabels, ASlowWayIsNoLaneChange) {
  EXPECT_EQ(lateral(std::vector<double>(40, 0.34)), std::vector<std::uint8_t>(40, 0));  // 1.36 m
}

TEST(MotionLabels, ThereAndBackAreTwoMotions) {
  EXPECT_EQ(lateral({6.0, 6.0, -6.0, -6.0}), letters("LLRR"));
  EXPECT_EQ(lateral({6.0, 3.0, -6.0, -6.0}), letters("MMRR")) << "0.9 m to the left";
}

TEST(MotionLabels, BrakingMustLast) {
  EXPECT_EQ(braking({0.0, -2.0, -2.0, -2.0, 0.0}).labels, letters("MBBBM"));
  EXPECT_EQ(braking({0.0, -9.0, -9.0, -1.9, -9.0, -9.0, 0.0}).labels, letters("MMMMMMM"));
}

TEST(MotionLabels, BrakingGoesOnUntilItIsWeak) {
  const auto labels = braking({-1.5, -3.0, -3.0, -3.0, -1.5, -1.01, -1.0, -1.5, 0.0});
  EXPECT_EQ(labels.labels, letters("MBBBBBMMM"));
  EXPECT_THAT(labels.braking_times, ElementsAre(DoubleNear(0.1, 1e-12)));
}

TEST(MotionLabels, TwoBrakingsAreTwo) {
  const auto labels = braking({-3.0, -3.0, -3.0, 0.0, -3.0, -3.0, -3.0, -3.0});
  EXPECT_EQ(labels.labels, letters("BBBMBBBB"));
  EXPECT_THAT(labels.braking_times, ElementsAre(0.0, DoubleNear(0.4, 1e-12)));
}

TEST(MotionLabels, BothAtOnceAreBrakingToASide) {
  EXPECT_EQ(motion_labels(std::vector{0.0, -3.0, -3.0, -3.0, -3.0},
                          std::vector{-6.0, -6.0, -6.0, 0.0, 6.0}, tenth)
                .labels,
            letters("RrrBB"));
  EXPECT_EQ(
      motion_labels(std::vector{-3.0, -3.0, -3.0, 0.0}, std::vector{0.0, 6.0, 6.0, 6.0}, tenth)
          .labels,
      letters("BllL"));
}

/// The definition, said the other way round: for each sample, look for what it belongs to.
bool changes_at(const std::vector<double>& v, std::size_t at, double sign) {
  std::size_t begin = at;
  std::size_t end = at;
  const auto moves = [&](std::size_t i) { return sign * v[i] >= 0.2; };
  if (!moves(at)) {
    return false;
  }
  while (begin > 0 && moves(begin - 1)) {
    --begin;
  }
  while (end + 1 < v.size() && moves(end + 1)) {
    ++end;
  }
  double way = 0.0;
  bool begun = false;
  for (std::size_t i = begin; i <= end; ++i) {
    way += sign * v[i] * tenth;
    begun = begun || (i <= at && sign * v[i] > 0.35);
  }
  return begun && way >= 1.0;
}

bool brakes_at(const std::vector<double>& a, std::size_t at) {
  for (std::size_t begin = at; a[begin] < -1.0; --begin) {
    if (begin + 2 < a.size() && a[begin] <= -2.0 && a[begin + 1] <= -2.0 && a[begin + 2] <= -2.0) {
      return true;
    }
    if (begin == 0) {
      break;
    }
  }
  return false;
}

TEST(MotionLabels, AreTheDefinitionSampleBySample) {
  std::mt19937_64 rng(11);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    std::vector<double> a{0.0};
    std::vector<double> v{0.0};
    for (int i = 0; i < 80; ++i) {  // random walks that return to zero
      a.push_back(0.9 * a.back() + 0.9 * normal(rng));
      v.push_back(0.9 * v.back() + 0.3 * normal(rng));
    }
    const auto labels = motion_labels(a, v, tenth).labels;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool left = changes_at(v, i, 1.0);
      const bool right = changes_at(v, i, -1.0);
      const bool brake = brakes_at(a, i);
      const std::string_view word = brake ? (left    ? "l"
                                             : right ? "r"
                                                     : "B")
                                          : (left    ? "L"
                                             : right ? "R"
                                                     : "M");
      ASSERT_EQ(labels[i], class_of(word[0])) << "round " << round << ", sample " << i;
    }
  }
}

TEST(MotionLabels, OfNothingAreNone) {
  EXPECT_THAT(motion_labels({}, {}, tenth).labels, IsEmpty());
  EXPECT_THAT(away_from_changes({}, tenth), IsEmpty());
}

TEST(MotionLabels, RefuseGapsAndUnequalSeries) {
  const std::vector<double> one{0.0};
  const std::vector<double> gap{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW((void)motion_labels(one, {}, tenth), ContractViolation);
  EXPECT_THROW((void)motion_labels(gap, one, tenth), ContractViolation);
  EXPECT_THROW((void)motion_labels(one, one, 0.0), ContractViolation);
}

TEST(AwayFromChanges, LeavesTwoFramesOnEitherSide) {
  EXPECT_THAT(away_from_changes(letters("MMMMBBBB"), tenth),
              ElementsAre(true, true, false, false, false, false, true, true));
  EXPECT_THAT(away_from_changes(letters("BM"), tenth), ElementsAre(false, false));
}

}  // namespace
}  // namespace saca::learn
