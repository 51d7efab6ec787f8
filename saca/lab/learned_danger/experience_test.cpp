#include "saca/lab/learned_danger/experience.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::learned_danger::experience_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

class ExperienceTest : public testing::Test {
 protected:
  ExperienceTest() { add_experience(all_, made_, body); }

  const manoeuvre::Car car_ = prepare::default_car();
  const danger::DangerModel model_{danger::avoidance_of(car_, 1.0), body, {}};
  const Transitions made_ = made_transitions(car_, body, model_, {}, {12, 7});
  Experience all_;
};

TEST_F(ExperienceTest, HoldsTheSituationsWithOneObstacle) {
  std::size_t single = 0;
  std::size_t ends = 0;
  for (std::size_t i = 0; i < made_.size(); ++i) {
    const float second =
        made_.observations[i * num_features + num_ego_features + num_obstacle_features];
    single += second == 0.0F ? 1U : 0U;
    ends += second == 0.0F && made_.settled[i] + made_.cut_off[i] > 0.0F ? 1U : 0U;
  }
  ASSERT_GT(single, 100U);
  EXPECT_EQ(all_.size(), single);
  EXPECT_EQ(all_.num_states(), single + ends) << "each situation has one state more";
  EXPECT_EQ(all_.inputs.size(), all_.num_states() * num_net_inputs);
  EXPECT_EQ(all_.actions.size(), 2 * single);
  EXPECT_EQ(all_.reached.size(), single);
}

TEST_F(ExperienceTest, IsOrderedInTime) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    ASSERT_LT(all_.row[i] + 1, all_.num_states());
    EXPECT_GE(all_.h[i], all_.h_at[all_.row[i]] - 1e-4F);
    EXPECT_GE(all_.h[i], all_.h_at[all_.row[i] + 1] - 1e-4F);
    EXPECT_GE(all_.h[i], -15.0F);
    EXPECT_GE(all_.reached[i], all_.h[i]);
    const bool goes_on = i + 1 < all_.size() && all_.row[i + 1] == all_.row[i] + 1;
    if (goes_on) {
      EXPECT_EQ(all_.reached[i], std::max(all_.h[i], all_.reached[i + 1]));
      EXPECT_EQ(all_.settled[i], 0.0F);
    } else if (all_.settled[i] == 0.0F) {
      EXPECT_TRUE(std::isinf(all_.reached[i])) << "its end was not seen";
    } else {
      EXPECT_LE(all_.reached[i], all_.h[i] + 1e-4F);
    }
  }
}

// A drive of 70 looks beside one obstacle that was cut off then: h is least at look 5 and deepest
// at look 64.
TEST(ReachedTest, LooksAheadToTheHorizon) {
  Transitions drive;
  constexpr int looks = horizon_looks + 10;
  const auto h_at = [](int look) { return look == 64 ? -1.0 : look == 5 ? -9.0 : -5.0; };
  Observation beside_one{};
  beside_one[num_ego_features] = 1.0F;
  beside_one[num_ego_features + 1] = 20.0F;
  beside_one[num_ego_features + 3] = 1.0F;
  beside_one[num_ego_features + 8] = 4.0F;
  beside_one[num_ego_features + 9] = 2.0F;
  for (int i = 0; i < looks; ++i) {
    drive.add({.observation = beside_one,
               .h = h_at(i),
               .next_observation = beside_one,
               .next_h = h_at(i),
               .is_cut_off = i + 1 == looks});
  }
  Experience all{.num_obstacles = 1};
  add_experience(all, drive, {.length = 4.0, .width = 2.0});
  ASSERT_EQ(all.size(), static_cast<std::size_t>(looks));
  EXPECT_EQ(all.reached[0], -5.0F);
  EXPECT_EQ(all.reached[4], -5.0F) << "up to look 63";
  EXPECT_EQ(all.reached[5], -1.0F) << "up to look 64";
  EXPECT_EQ(all.reached[10], -1.0F) << "to the end, which is the horizon";
  EXPECT_TRUE(std::isinf(all.reached[11])) << "the drive ended before";
  drive.cut_off.back() = 0.0F;
  drive.settled.back() = 1.0F;
  Experience settled{.num_obstacles = 1};
  add_experience(settled, drive, {.length = 4.0, .width = 2.0});
  EXPECT_EQ(settled.reached[11], -1.0F);
  EXPECT_EQ(settled.reached[65], -5.0F);
}

/// Two situations, of four looks and of three: what is done in each look is a letter, and h rises
/// by 1 from look to look. The first ends unsettled, the second settled.
Experience two_situations(const std::string& first, const std::string& second) {
  Experience all{.num_obstacles = 1};
  for (const std::string* which : {&first, &second}) {
    const std::string& letters = *which;
    for (std::size_t i = 0; i < letters.size(); ++i) {
      all.row.push_back(static_cast<std::uint32_t>(all.num_states()));
      all.next_row.push_back(all.row.back() + 1);
      all.inputs.insert(all.inputs.end(), num_net_inputs, 0.0F);
      all.h_at.push_back(0.0F);
      all.actions.insert(all.actions.end(), {static_cast<float>(letters[i]), 0.0F});
      all.h.push_back(static_cast<float>(all.row.back()));
      all.settled.push_back(which == &second && i + 1 == letters.size() ? 1.0F : 0.0F);
      all.reached.push_back(99.0F);
    }
    all.inputs.insert(all.inputs.end(), num_net_inputs, 0.0F);
    all.h_at.push_back(0.0F);
  }
  return all;
}

TEST(KeepHeld, LeadsFromWhereOneInputStaysToWhereItEnds) {
  Experience all = two_situations("aaab", "bcc");
  keep_held(all, 2);
  // aa, aa of the first; of the second not bc, but cc, and the last c, after which all is settled.
  EXPECT_EQ(all.row, (std::vector<std::uint32_t>{0, 1, 6, 7}));
  EXPECT_EQ(all.next_row, (std::vector<std::uint32_t>{2, 3, 8, 8}));
  EXPECT_EQ(all.h, (std::vector<float>{1.0F, 2.0F, 7.0F, 7.0F})) << "the deepest of both";
  EXPECT_EQ(all.settled, (std::vector<float>{0.0F, 0.0F, 1.0F, 1.0F}));
  EXPECT_EQ(all.actions, (std::vector<float>{'a', 0.0F, 'a', 0.0F, 'c', 0.0F, 'c', 0.0F}));
  EXPECT_EQ(all.reached.size(), 4U);
  EXPECT_EQ(all.num_states(), 9U) << "states stay";
}

TEST(KeepHeld, OfOneLookKeepsAll) {
  Experience all = two_situations("ab", "cc");
  const Experience before = all;
  keep_held(all, 1);
  EXPECT_EQ(all.row, before.row);
  EXPECT_EQ(all.next_row, before.next_row);
  EXPECT_EQ(all.h, before.h);
}

}  // namespace
}  // namespace saca::learned_danger::experience_test
