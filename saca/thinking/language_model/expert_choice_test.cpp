#include "saca/thinking/language_model/expert_choice.h"

#include <gtest/gtest.h>

#include "saca/thinking/language_model/left_is_open_for_test.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::language_model::expert_choice_test {
namespace {

using manoeuvre::PolicyId;

TEST(ExpertChoice, AdmitsWhatForecastsCannotTellFromTheBest) {
  preview::Situation situation = left_is_open();
  of(situation, PolicyId::aes_left).outcome().harm = 0.001;
  // Braking has 0.1 above the best, 3 % of which are 0.003.
  of(situation, PolicyId::es_b_right).outcome().harm = 0.0029;
  of(situation, PolicyId::aes_right).outcome().harm = 0.0031;
  const memory::Policies may = admissible(situation.facts);
  EXPECT_EQ(may, memory::Policies("00011010"));  // 1, 3 and 4
}

TEST(ExpertChoice, ChoosesByWhatIsKnownAmongTheAdmissible) {
  preview::Situation situation = left_is_open();
  memory::PolicyHarms known;
  known[1] = 0.01;
  known[3] = 0.05;
  known[0] = 0.0;  // not admissible by what was forecast
  EXPECT_EQ(expert_choice(situation.facts, known), PolicyId::aes_left);
  known[3] = 0.011;  // as good, and milder
  EXPECT_EQ(expert_choice(situation.facts, known), PolicyId::es_b_left);
}

TEST(ExpertChoice, ChoosesByForecastWhereSomethingIsNotKnown) {
  preview::Situation situation = left_is_open();
  of(situation, PolicyId::es_b_left).outcome().harm = 0.0005;
  memory::PolicyHarms known;
  known[3] = 0.5;
  EXPECT_EQ(expert_choice(situation.facts, known), PolicyId::es_b_left);
}

TEST(ExpertChoice, ChoosesTheBetterForecastOfEquallyMild) {
  preview::Situation situation = left_is_open();
  auto& end = of(situation, PolicyId::es_b_right).end.emplace<preview::ExpectedOutcome>();
  end.outcome.clearance = 2.5;
  EXPECT_EQ(expert_choice(situation.facts, {}), PolicyId::es_b_right);
}

// One draw in which it ends badly does not tell another prompt from this one; what is begun is
// looked at again.
TEST(ExpertChoice, DoesNothingWhereThatCannotBeToldFromTheBest) {
  preview::Situation situation = left_is_open();
  auto& end = of(situation, PolicyId::no_intervention).end.emplace<preview::ExpectedOutcome>();
  end.outcome.clearance = 0.2;
  memory::PolicyHarms known;
  known[1] = known[3] = known[4] = 0.0;
  known[7] = 0.5;
  EXPECT_EQ(expert_choice(situation.facts, known), PolicyId::no_intervention);
}

}  // namespace
}  // namespace saca::language_model::expert_choice_test
