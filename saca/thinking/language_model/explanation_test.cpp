#include "saca/thinking/language_model/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "saca/base/core/contract.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/expert.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::language_model::explanation_test {
namespace {

using From = Explanation::From;
using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// AEB is clear by 0.62 m, everything else that can be driven hits truck1.
class ExplanationTest : public testing::Test {
 protected:
  [[nodiscard]] Explanation of(const std::string& reasoning,
                               PolicyId chosen = PolicyId::aeb) const {
    return explanation(reasoning, prompt_, situation_, std::nullopt, chosen);
  }

  preview::Situation situation_ = example_situation();
  std::string prompt_ = scene_part(situation_, std::nullopt, 0.0);
};

TEST_F(ExplanationTest, WhatIsTrueIsShownAsItWasWritten) {
  const Explanation told =
      of("Scenario Analysis\n" + std::string(example_reasons) + "Response to user:");
  EXPECT_EQ(told.from, From::model);
  EXPECT_EQ(told.text, example_reasons);
}

TEST_F(ExplanationTest, WhatIsFalseOrSaysNothingIsLeftOut) {
  const Explanation told =
      of("1. NI is clear.\n2. This is a difficult scene.\n3. AES-L hits truck1.\n4. So AEB: it is "
         "clear by 0.6 m.\n");
  EXPECT_EQ(told.from, From::model_in_part);
  EXPECT_EQ(told.text, "1. AES-L hits truck1.\n2. So AEB: it is clear by 0.6 m.\n");
}

TEST_F(ExplanationTest, WithoutATrueConclusionTheFactsSpeak) {
  for (const char* reasoning : {"", "1. 1.1.1:", "1. NI hits truck1.\n2. So AEB: it hits truck1.\n",
                                "1. NI hits truck1.\n2. So AES-R hits truck1.\n",
                                "1. NI hits truck1.\n2. So AES-R, and AEB is clear by 0.6 m.\n",
                                "no statement, AEB is clear by 0.6 m"}) {
    const Explanation told = of(reasoning);
    EXPECT_EQ(told.from, From::facts) << reasoning;
    EXPECT_THAT(told.text, StartsWith("1. ")) << reasoning;
    EXPECT_THAT(told.text, HasSubstr("AEB: ")) << reasoning;
  }
  EXPECT_EQ(of("").text, of("1. 1.1.1:").text) << "the same words for the same prompt";
}

// Emergency braking harms nobody, a lane change to the right does.
TEST_F(ExplanationTest, OfWhatIsNotAdmissibleTheFactsAreTold) {
  situation_.facts[2].outcome().harm = 0.3;
  prompt_ = scene_part(situation_, std::nullopt, 0.0);
  const Explanation told = of("", PolicyId::aes_right);
  EXPECT_EQ(told.from, From::facts);
  EXPECT_THAT(told.text, StartsWith("1. 2 AES-R: hits truck1"));
  EXPECT_THAT(told.text, HasSubstr("\n2. The best forecast is that of 0 AEB: clear by 0.6 m"));
  EXPECT_THROW((void)of("", PolicyId::t_drift_left), ContractViolation);
}

// Whatever is written, nothing false is shown.
TEST_F(ExplanationTest, PassesTheTruthCheck) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const preview::Situation situation = crowded_situation(seed);
    const std::string prompt = scene_part(situation, std::nullopt, 0.0);
    const PolicyId chosen = expert_choice(situation.facts, {});
    const std::string written = "1. NI is clear.\n2. AEB hits truck1, harm 0.9999.\n3. So " +
                                std::string(name(chosen)) + ": it has the least harm.\n";
    const Explanation told = explanation(written, prompt, situation, std::nullopt, chosen);
    const Truth truth = truth_of(told.text, prompt, situation, chosen);
    EXPECT_GT(truth.num_checked, 0) << told.text;
    EXPECT_TRUE(truth.wrong.empty()) << told.text;
  }
}

}  // namespace
}  // namespace saca::language_model::explanation_test
