#include "saca/onboard/forecast/plans.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace saca::forecast::plans_test {
namespace {

using manoeuvre::Plan;
using manoeuvre::PolicyId;

TEST(PolicyFacts, PlansAreThePapersPoliciesAndTheirParameters) {
  const Plans all = all_plans(20.0);
  EXPECT_EQ(all.size(), 8U + 2 * 3 + 4);
  EXPECT_EQ(all_plans(20.0, Braking::full).size(), 8U + 2 * 3);
  EXPECT_EQ(all[0], manoeuvre::full_braking);
  for (std::size_t i = 1; i <= 4; ++i) {  // from hard to gentle
    EXPECT_EQ(all[i].policy, PolicyId::aeb);
    EXPECT_LT(strength_of(all[i]), strength_of(all[i - 1]));
  }
}

}  // namespace
}  // namespace saca::forecast::plans_test
