#include "saca/danger/experience.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "saca/manoeuvre/default_car.h"
#include "saca/reach/car_limits.h"

namespace saca::danger::experience_test {
namespace {

const world::Footprint body{.length = 4.3, .width = 1.8, .centre_x = 0.1};

class ExperienceTest : public testing::Test {
 protected:
  ExperienceTest() { add_experience(all_, made_, body); }

  const manoeuvre::Car car_ = manoeuvre::default_car();
  const reach::DangerModel model_{reach::avoidance_of(car_, 1.0), body, {}};
  const Transitions made_ = made_transitions(car_, body, model_, {}, 12, 7);
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

}  // namespace
}  // namespace saca::danger::experience_test
