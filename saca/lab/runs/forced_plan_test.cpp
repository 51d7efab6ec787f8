#include "saca/lab/runs/forced_plan.h"

#include <gmock/gmock.h>

namespace saca::runs::forced_plan_test {
namespace {

using manoeuvre::PolicyId;
using testing::StartsWith;

TEST(AForcedPlan, IsNoneWhereNothingIsForced) {
  EXPECT_EQ(forced_plan({}).value(), std::nullopt);
}

TEST(AForcedPlan, HasTheSpeedOrStrengthThatItsPolicyTakes) {
  EXPECT_EQ(forced_plan({.policy = PolicyId::es_b_left, .target_speed = 7.0}).value(),
            (manoeuvre::Plan{PolicyId::es_b_left, 7.0}));
  EXPECT_EQ(forced_plan({.policy = PolicyId::aeb, .strength = 0.5}).value(),
            (manoeuvre::Plan{PolicyId::aeb, std::nullopt, 0.5}));
  EXPECT_EQ(forced_plan({.policy = PolicyId::aes_left}).value(),
            (manoeuvre::Plan{PolicyId::aes_left, std::nullopt}));
}

TEST(AForcedPlan, RefusesWhatItsPolicyDoesNotTake) {
  EXPECT_THAT(forced_plan({.strength = 0.5}).error().message, StartsWith("--strength: only of"));
  EXPECT_THAT(forced_plan({.policy = PolicyId::es_b_left, .strength = 0.5}).error().message,
              StartsWith("--strength: only of --policy 0"));
  const Error speed = forced_plan({.policy = PolicyId::aeb, .target_speed = 7.0}).error();
  EXPECT_EQ(speed.message, "--target-speed: only of --policy 3 and 4");
  EXPECT_EQ(speed.code, Error::Code::out_of_range);
  EXPECT_THAT(forced_plan({.target_speed = 7.0}).error().message, StartsWith("--target-speed: "));
}

}  // namespace
}  // namespace saca::runs::forced_plan_test
