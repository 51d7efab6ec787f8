#include "saca/lab/banks/case_check.h"

#include <gtest/gtest.h>

#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/trigger_case.h"

namespace saca::banks::case_check_test {
namespace {

using manoeuvre::PolicyId;
using memory::Trust;

constexpr std::size_t draws = 16;

// Braking needs 49 m and has 28.6 m; to the right is a barrier: only the left helps.
class CaseCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    const scenario::Scenario scenario = eval::only_left_helps();
    one_ = eval::case_at_trigger({&scenario, &car_, &harm_, &intent_, {}, {}}, tools_, draws,
                                 made_with_)
               .value()
               .value();
    one_.trust = Trust::unchecked;
  }
  [[nodiscard]] std::optional<memory::Case> check(const memory::Case& one) const {
    return checked(one, tools_, intent_, draws, made_with_);
  }
  /// What somebody says is best there, without figures.
  [[nodiscard]] memory::Case said(PolicyId best) const {
    memory::Case one = one_;
    one.best = best;
    one.told.reset();
    one.happened.reset();
    one.intentions.clear();
    one.made_with.clear();
    return one;
  }

  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  const intent::Model& intent_ = intent::shipped_model();
  preview::ForecastTools tools_{&car_, &harm_};
  std::vector<memory::MadeWith> made_with_ = encounter::made_with(tools_, intent_, "a car");
  memory::Case one_;
};

TEST_F(CaseCheckTest, ConfirmsWhatItWouldSayItself) {
  const memory::Case checked = check(one_).value();
  EXPECT_EQ(checked.trust, Trust::trusted);
  EXPECT_EQ(checked.told, one_.told) << "the same car, draws and beliefs";
  EXPECT_EQ(checked.happened, one_.happened);
  EXPECT_FALSE(memory::broken_rule(checked));
}

TEST_F(CaseCheckTest, ConfirmsAnExpertWhoIsRight) {
  const memory::Case checked = check(said(PolicyId::es_b_left)).value();
  EXPECT_EQ(checked.trust, Trust::trusted);
  EXPECT_TRUE(checked.told);
  EXPECT_EQ(checked.made_with, made_with_);
}

// Else it would count as an encounter in which nobody was harmed.
TEST_F(CaseCheckTest, LeavesAnExpertsWordHearsay) {
  memory::Case word = said(PolicyId::es_b_left);
  word.origin = memory::Origin::expert;
  ASSERT_TRUE(memory::is_hearsay(word));
  EXPECT_TRUE(memory::is_hearsay(check(word).value()));
}

TEST_F(CaseCheckTest, LeavesOpenWhatIsNoWorseThanBraking) {
  EXPECT_FALSE(check(said(PolicyId::aeb)).has_value());
}

TEST_F(CaseCheckTest, RefutesWhatIsWorseThanBraking) {
  const memory::Case checked = check(said(PolicyId::no_intervention)).value();
  EXPECT_EQ(checked.trust, Trust::quarantined);
}

TEST_F(CaseCheckTest, ForgetsWhatHappenedToAnotherCar) {
  memory::Case one = one_;
  one.made_with[0].digest = "0123456789abcdef";
  const memory::Case checked = check(one).value();
  EXPECT_EQ(checked.trust, Trust::trusted);
  EXPECT_FALSE(checked.happened);
  EXPECT_EQ(checked.made_with, made_with_);
}

// Else what the first check worked out would be what the second confirms.
TEST_F(CaseCheckTest, LeavesWhatItLeavesOpenAsItWasForAnotherCarToo) {
  memory::Case one = one_;
  one.made_with[0].digest = "0123456789abcdef";
  one.told = memory::PolicyHarms{0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  one.happened = one.told;  // only braking helped that car
  ASSERT_EQ(memory::as_good_as_best(one), memory::Policies(1U));
  EXPECT_FALSE(check(one).has_value());
}

}  // namespace
}  // namespace saca::banks::case_check_test
