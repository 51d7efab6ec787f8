#include "saca/onboard/collision/loss.h"

#include <gtest/gtest.h>

#include <limits>

#include "saca/base/core/contract.h"

namespace saca::collision::loss_test {
namespace {

using manoeuvre::PolicyId;

// The paper, section V-B: relative velocity times 0.41 (side), 0.35 (front), 0.21 (rear). Its own
// example in V-D: collisions at 1.2 m/s cost 0.492, which is 0.41 x 1.2.
TEST(CollisionLoss, IsThePapers) {
  EXPECT_DOUBLE_EQ(collision_loss(Face::left, 1.2), 0.492);
  EXPECT_DOUBLE_EQ(collision_loss(Face::right, 1.2), 0.492);
  EXPECT_DOUBLE_EQ(collision_loss(Face::front, 10.0), 3.5);
  EXPECT_DOUBLE_EQ(collision_loss(Face::rear, 10.0), 2.1);
  EXPECT_EQ(collision_loss(Face::front, 0.0), 0.0);
}

TEST(CollisionLoss, RefusesWhatIsNoSpeed) {
  EXPECT_THROW((void)collision_loss(Face::front, -1.0), ContractViolation);
  EXPECT_THROW((void)collision_loss(Face::front, std::numeric_limits<double>::quiet_NaN()),
               ContractViolation);
}

TEST(FalseTriggerLoss, IsThePapers) {
  for (const int id : {0, 1, 2, 3, 4}) {
    EXPECT_EQ(false_trigger_loss(static_cast<PolicyId>(id)), 0.5) << id;
  }
  EXPECT_EQ(false_trigger_loss(PolicyId::t_drift_left), 1.0);
  EXPECT_EQ(false_trigger_loss(PolicyId::t_drift_right), 1.0);
  EXPECT_EQ(false_trigger_loss(PolicyId::no_intervention), 0.0);
}

}  // namespace
}  // namespace saca::collision::loss_test
