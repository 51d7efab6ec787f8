#include "saca/thinking/language_model/statements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "saca/thinking/language_model/left_is_open_for_test.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::language_model::statements_test {
namespace {

using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::IsEmpty;

const std::optional<memory::Case> no_case;

TEST(Statements, QuoteThePromptAboutARoadUser) {
  const preview::Situation situation = left_is_open();
  const std::string prompt = scene_part(situation, no_case, 0.0);
  const Statements statements(situation, prompt, no_case);
  ASSERT_EQ(statements.most_dangerous(), 0U);
  const RoadUserPieces truck = statements.pieces_of(0);
  EXPECT_EQ(truck.who, "truck1, 16 m ahead");
  EXPECT_EQ(truck.beside, ", 6.4 m left");
  EXPECT_EQ(truck.intention, ", maintain 0.88");
  EXPECT_EQ(truck.risk, ", risk 0.94");
  EXPECT_EQ(truck.unprotected, "");
  EXPECT_EQ(statements.pieces_of(1).unprotected, ", unprotected");
  EXPECT_EQ(statements.end_beside(PolicyId::aeb, 0), "AEB hits it");
  EXPECT_EQ(statements.end_beside(PolicyId::aeb, 1), "");  // it hits the truck
  EXPECT_EQ(statements.end_of(PolicyId::aeb), "AEB hits truck1");
  EXPECT_EQ(statements.with_harm(PolicyId::aeb), ", harm 0.10");
  EXPECT_EQ(statements.end_of(PolicyId::t_drift_left), "T-D-L is not possible");
  EXPECT_EQ(statements.end_beside(PolicyId::t_drift_left, 0), "");
}

// Where somebody is straight ahead, "0.4 m right" says nothing; nor does a line that is not there.
TEST(Statements, LeaveOutWhatSaysNothing) {
  preview::Situation situation = left_is_open();
  situation.scene_at_trigger.actors[0].X_WA.p = {16.0, -0.4};
  const std::string prompt = without_risks(scene_part(situation, no_case, 0.0));
  const Statements statements(situation, prompt, no_case);
  EXPECT_EQ(statements.pieces_of(0).beside, "");
  EXPECT_EQ(statements.pieces_of(0).risk, "");
  const Statements without(situation, "", no_case);
  EXPECT_FALSE(without.is_told(0));
  EXPECT_EQ(without.most_dangerous(), std::nullopt);
  EXPECT_EQ(without.end_of(PolicyId::aeb), "");
}

TEST(Statements, TellWhatSpeaksForTheOneOfTwo) {
  preview::Situation situation = left_is_open();
  const std::string prompt = scene_part(situation, no_case, 0.0);
  const Statements statements(situation, prompt, no_case);
  EXPECT_FALSE(statements.is_alone());
  EXPECT_EQ(statements.conclusion(PolicyId::es_b_left, PolicyId::aes_left),
            "So ES-B-L: as good as AES-L");
  EXPECT_THAT(statements.advantages(PolicyId::es_b_left, PolicyId::aes_left),
              ElementsAre(", and milder"));
  EXPECT_THAT(statements.advantages(PolicyId::aes_left, PolicyId::es_b_left), IsEmpty());
  of(situation, PolicyId::es_b_left).end.emplace<preview::ExpectedOutcome>().contact_probability =
      0.3;
  EXPECT_THAT(statements.advantages(PolicyId::aes_left, PolicyId::es_b_left),
              ElementsAre(", and touches somebody less often"));
}

TEST(Statements, TellTheNextBestOfOneThatIsAlone) {
  preview::Situation situation = left_is_open();
  of(situation, PolicyId::aes_left).outcome().harm = 0.02;
  const std::string prompt = scene_part(situation, no_case, 0.0);
  const Statements statements(situation, prompt, no_case);
  EXPECT_TRUE(statements.is_alone());
  ASSERT_EQ(statements.next_best(PolicyId::es_b_left), PolicyId::no_intervention);
  EXPECT_EQ(statements.conclusion(PolicyId::es_b_left, PolicyId::no_intervention),
            "So ES-B-L: least harm, next NI");
  EXPECT_THAT(statements.advantages(PolicyId::es_b_left, PolicyId::no_intervention),
              ElementsAre(", harm 0.013"));
}

// A remark that rules a side out says so: whoever goes there cannot make it.
TEST(Statements, RemarksKnowTheirSide) {
  preview::Situation situation = left_is_open();
  memory::Case nearest;
  nearest.best = PolicyId::es_b_left;
  const std::optional<memory::Case> found = nearest;
  const std::string prompt = scene_part(situation, found, 0.9);
  const std::vector<Remark> remarks = Statements(situation, prompt, found).remarks();
  ASSERT_GE(remarks.size(), 3U);
  EXPECT_EQ(remarks.front().side, 1);
  EXPECT_FALSE(remarks.front().rules_out);
  EXPECT_THAT(remarks.front().wordings, testing::Each(testing::HasSubstr("ES-B-L is clear")));
  const auto right = std::find_if(remarks.begin(), remarks.end(),
                                  [](const Remark& one) { return one.side == -1; });
  ASSERT_NE(right, remarks.end());
  EXPECT_TRUE(right->rules_out);
  EXPECT_THAT(right->wordings,
              ElementsAre("The way to the right is blocked", "All to the right is blocked"));
  EXPECT_THAT(remarks.back().wordings,
              ElementsAre("In the most alike case ES-B-L was best in hindsight",
                          "In the nearest case ES-B-L was best in hindsight"));
}

// What somebody told of a case is no hindsight.
TEST(Statements, SayNothingOfHearsay) {
  const preview::Situation situation = left_is_open();
  memory::Case told;
  told.origin = memory::Origin::expert;
  told.best = PolicyId::aes_left;
  ASSERT_TRUE(memory::is_hearsay(told));
  const std::optional<memory::Case> found = told;
  const std::string prompt = scene_part(situation, found, 0.9);
  const Statements statements(situation, prompt, found);
  for (const Remark& remark : statements.remarks()) {
    EXPECT_THAT(remark.wordings, testing::Each(testing::Not(testing::HasSubstr("case"))));
  }
  EXPECT_THAT(statements.advantages(PolicyId::aes_left, PolicyId::es_b_left), IsEmpty());
}

}  // namespace
}  // namespace saca::language_model::statements_test
