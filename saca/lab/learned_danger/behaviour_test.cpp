#include "saca/lab/learned_danger/behaviour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::learned_danger::behaviour_test {
namespace {

using manoeuvre::Demand;

std::vector<Demand> demands(Behaviour behaviour, std::uint64_t seed, int looks,
                            Driver::Evasion evasion = {}) {
  Driver driver(behaviour, seed, std::move(evasion));
  std::vector<Demand> all(static_cast<std::size_t>(looks));
  for (Demand& demand : all) {
    demand = driver.next({});
  }
  return all;
}

double size(const Demand& demand) {
  return std::hypot(demand.along, demand.across);
}

bool same(const Demand& a, const Demand& b) {
  return a.along == b.along && a.across == b.across;
}

/// How many looks each demand is held, in sequence, the last left out.
std::vector<int> runs(const std::vector<Demand>& all) {
  std::vector<int> lengths{1};
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (same(all[i], all[i - 1])) {
      ++lengths.back();
    } else {
      lengths.push_back(1);
    }
  }
  lengths.pop_back();
  return lengths;
}

Demand braking(const Ego& /*ego*/, double /*time*/) {
  return {-1.0, 0.0};
}

TEST(Behaviour, StaysOnTheDiscAndIsTheSeeds) {
  for (const Behaviour behaviour :
       {Behaviour::held, Behaviour::bang_bang, Behaviour::manoeuvre, Behaviour::evasion}) {
    const auto first = demands(behaviour, 5, 2'000, braking);
    const auto again = demands(behaviour, 5, 2'000, braking);
    const auto other = demands(behaviour, 6, 2'000, braking);
    int differing = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_LE(size(first[i]), 1.0 + 1e-12) << name(behaviour);
      ASSERT_TRUE(same(first[i], again[i])) << name(behaviour);
      differing += same(first[i], other[i]) ? 0 : 1;
    }
    EXPECT_GT(differing, 1'000) << name(behaviour);
  }
}

TEST(Behaviour, HoldsEachDemandForTwoToTenLooks) {
  const auto all = demands(Behaviour::held, 1, 5'000);
  int full = 0;
  const auto lengths = runs(all);
  for (const int length : lengths) {
    EXPECT_GE(length, 2);
    EXPECT_LE(length, 10);
  }
  for (const Demand& demand : all) {
    full += size(demand) > 1.0 - 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(full / 5'000.0, 1.0 / 3.0, 0.06);
}

// To every side as often: what is learnt on one side holds on the other.
TEST(Behaviour, BangsEachWayAsOften) {
  std::map<std::pair<int, int>, int> counts;
  for (const Demand& demand : demands(Behaviour::bang_bang, 3, 30'000)) {
    EXPECT_TRUE(size(demand) == 0.0 || std::abs(size(demand) - 1.0) < 1e-12);
    ++counts[{static_cast<int>(std::lround(10.0 * demand.along)),
              static_cast<int>(std::lround(10.0 * demand.across))}];
  }
  EXPECT_EQ(counts.size(), 9U);
  for (const auto& [which, count] : counts) {
    EXPECT_NEAR(count / 30'000.0, 1.0 / 9.0, 0.02);
  }
}

// As the policies: it brakes in most, swerves out and back, and never speeds up but by jitter.
TEST(Behaviour, ManoeuvresBrakeOrSwerve) {
  int braking_looks = 0;
  double across = 0.0;
  double most_along = -1.0;
  const auto all = demands(Behaviour::manoeuvre, 7, 20'000);
  for (const Demand& demand : all) {
    braking_looks += demand.along < -0.2 ? 1 : 0;
    across += demand.across;
    most_along = std::max(most_along, demand.along);
  }
  EXPECT_GT(braking_looks, 10'000);
  EXPECT_LT(most_along, 0.3);
  EXPECT_NEAR(across / 20'000.0, 0.0, 0.02) << "to either side alike";
}

TEST(Behaviour, AnEvasionIsFollowedWithNoise) {
  double along = 0.0;
  int elsewhere = 0;
  for (const Demand& demand : demands(Behaviour::evasion, 2, 10'000, braking)) {
    elsewhere += demand.along > -0.4 ? 1 : 0;
    along += demand.along;
  }
  EXPECT_LT(along / 10'000.0, -0.75);
  EXPECT_GT(elsewhere, 300) << "what is around it is there, too";
  EXPECT_LT(elsewhere, 1'500);
  EXPECT_THROW(std::ignore = Driver(Behaviour::evasion, 1), ContractViolation);
}

// While something else is held, time goes on: the obstacle is where it is then.
TEST(Behaviour, AnEvasionIsToldTheTime) {
  std::vector<double> times;
  int look = 0;
  Driver driver(Behaviour::evasion, 2, [&](const Ego& /*ego*/, double time) {
    EXPECT_NEAR(time, look_step * look, 1e-9);
    times.push_back(time);
    return Demand{};
  });
  for (; look < 1'000; ++look) {
    std::ignore = driver.next({});
  }
  EXPECT_GT(times.size(), 700U);
  EXPECT_LT(times.size(), 950U) << "something else is held now and then";
}

}  // namespace
}  // namespace saca::learned_danger::behaviour_test
