#include "saca/thinking/language_model/claim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace saca::language_model::claim_test {
namespace {

using testing::ElementsAre;

TEST(Claim, IsReadFromItsWords) {
  EXPECT_EQ(claim_of("t-d-l is not possible"), Claim::not_possible);
  EXPECT_EQ(claim_of("left is blocked"), Claim::blocked);
  EXPECT_EQ(claim_of("aes-r hits truck1"), Claim::hits);
  EXPECT_EQ(claim_of("aes-r does not hit truck1"), Claim::clear);
  EXPECT_EQ(claim_of("aeb avoids a hit"), Claim::clear);
  EXPECT_EQ(claim_of("aeb is clear by 0.6 m"), Claim::clear);
  EXPECT_EQ(claim_of("aeb does no harm"), Claim::no_harm);
  EXPECT_EQ(claim_of("aeb: least harm, no harm"), Claim::least_harm);
  EXPECT_EQ(claim_of("aes-l leaves the road"), Claim::leaves);
  EXPECT_EQ(claim_of("policies 1 and 3 leave the road"), Claim::leaves);
  EXPECT_EQ(claim_of("a van is ahead"), std::nullopt);
  EXPECT_EQ(claim_of("wet leaves on the road"), std::nullopt);
  EXPECT_EQ(claim_of(""), std::nullopt);
}

TEST(Claim, IsNoneWhereItIsDeniedInAnotherWay) {
  for (const char* denied : {"it isn't blocked", "all but aeb are blocked", "nothing is clear",
                             "the left is not blocked", "it is unclear", "never clear",
                             "it does not leave the road", "it cannot leave the road"}) {
    EXPECT_EQ(claim_of(denied), std::nullopt) << denied;
  }
  EXPECT_FALSE(is_denied("it is not possible"));
  EXPECT_TRUE(is_denied("it is not so"));
}

TEST(Claim, IsNotDeniedByWhatACueIsCalled) {
  const std::string siren = "the siren of an emergency vehicle that is not seen";
  EXPECT_EQ(without_cues(siren + " and " + siren), "the  and the ");
  EXPECT_FALSE(is_denied("aeb keeps away from " + siren));
  EXPECT_TRUE(is_denied("aeb is not near " + siren));
  EXPECT_EQ(claim_of("near " + siren + " aeb is clear"), Claim::clear);
}

TEST(Claim, StandsInAClauseOfItsOwn) {
  EXPECT_THAT(clauses("1 and 3 are blocked, 2 is clear"),
              ElementsAre("1 and 3 are blocked", "2 is clear"));
  EXPECT_THAT(clauses("truck1, 16 m ahead, hits"), ElementsAre("truck1, 16 m ahead, hits"))
      << "nothing is claimed before the commas";
  EXPECT_THAT(clauses(""), ElementsAre(""));
}

}  // namespace
}  // namespace saca::language_model::claim_test
