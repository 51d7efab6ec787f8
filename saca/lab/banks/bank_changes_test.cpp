#include "saca/lab/banks/bank_changes.h"

#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::bank_changes_test {
namespace {

using manoeuvre::PolicyId;
using memory::Trust;

TEST(ExpertCase, IsHearsayThatIsNotTrusted) {
  world::Scene scene = match::empty_road();
  scene.ego.v_B.x = 12.0;
  const memory::Case one =
      expert_case(scene, {PolicyId::es_b_right, "the truck is slow", "crossing"});
  EXPECT_EQ(one.origin, memory::Origin::expert);
  EXPECT_EQ(one.trust, Trust::unchecked);
  EXPECT_EQ(one.best, PolicyId::es_b_right);
  EXPECT_EQ(one.plan, manoeuvre::default_plan(PolicyId::es_b_right, 12.0));
  EXPECT_EQ(one.review, "the truck is slow");
  EXPECT_EQ(one.source, "crossing");
  EXPECT_TRUE(memory::is_hearsay(one));
  EXPECT_FALSE(memory::broken_rule(one));
}

TEST(ExpertCase, IsToldByWhatBecameOfIt) {
  using How = memory::LearningResult::How;
  EXPECT_EQ(text_of({How::added, 4, 0}, "bank"),
            "bank: case 4; it is used where a rollout confirms it\n");
  EXPECT_EQ(text_of({How::merged, 4, 0}, "bank"),
            "bank: case 4 stands for it already; it is used where a rollout confirms it\n");
  EXPECT_EQ(text_of({How::contradicted, 4, 2}, "bank"),
            "bank: case 4, which contradicts case 2; it is used where a rollout confirms it\n");
}

class Import : public testing::Test {
 protected:
  EmptyFolder folder_;
  memory::Store bank_ = open_to_add(folder_.file("bank")).value();
  std::vector<memory::Case> cases_{best_is(PolicyId::aeb, 10.0, "a"),
                                   best_is(PolicyId::aeb, 20.0, "b")};
};

TEST_F(Import, WithdrawsTrustUnlessItIsOnesOwn) {
  cases_[1].trust = Trust::quarantined;
  ASSERT_TRUE(import_cases(bank_, cases_, ImportedTrust::withdrawn).has_value());
  EXPECT_EQ(bank_.find(1).value()->trust, Trust::unchecked);
  EXPECT_EQ(bank_.find(2).value()->trust, Trust::quarantined) << "it gets no better";
  const std::vector own{best_is(PolicyId::aeb, 15.0, "c")};
  ASSERT_TRUE(import_cases(bank_, own, ImportedTrust::kept).has_value());
  EXPECT_EQ(bank_.find(3).value()->trust, Trust::trusted);
}

TEST_F(Import, LeavesOutWhatIsThereAndWhatComesTwice) {
  cases_.push_back(cases_[0]);
  cases_.back().review = "said otherwise";
  const CaseImport first = import_cases(bank_, cases_, ImportedTrust::withdrawn).value();
  EXPECT_EQ(first.taken, 2U);
  EXPECT_EQ(first.left_out, 1U);
  cases_[0].source = "another encounter";
  const CaseImport second = import_cases(bank_, cases_, ImportedTrust::withdrawn).value();
  EXPECT_EQ(second.taken, 1U);
  EXPECT_EQ(second.left_out, 2U);
  EXPECT_EQ(bank_.all().value().size(), 3U);
}

TEST_F(Import, LeavesOutWhatAnotherProcessHasAddedSinceTheBankWasOpened) {
  memory::Store other = open_to_add(folder_.file("bank")).value();
  ASSERT_TRUE(import_cases(other, {cases_[1]}, ImportedTrust::withdrawn).has_value());
  const CaseImport import = import_cases(bank_, cases_, ImportedTrust::withdrawn).value();
  EXPECT_EQ(import.taken, 1U);
  EXPECT_EQ(import.left_out, 1U);
  EXPECT_EQ(bank_.all().value().size(), 2U);
}

TEST_F(Import, IsToldInALine) {
  EXPECT_EQ(text_of(CaseImport{"bank", 5, 0, ImportedTrust::withdrawn}),
            "bank: 5 cases taken over: each is used only where a rollout confirms it\n");
  EXPECT_EQ(text_of(CaseImport{"bank", 5, 2, ImportedTrust::kept}),
            "bank: 5 cases taken over, 2 were there already\n");
  EXPECT_EQ(text_of(CaseImport{"bank", 0, 2, ImportedTrust::withdrawn}),
            "bank: 0 cases taken over, 2 were there already\n");
}

TEST(Thinning, ForgetsWhatAnotherStandsFor) {
  const EmptyFolder folder;
  {
    memory::Store store = open_to_add(folder.file("bank")).value();
    ASSERT_TRUE(store
                    .add_all(std::vector{best_is(PolicyId::aeb, 10.0, "a"),
                                         best_is(PolicyId::aeb, 10.1, "b"),
                                         best_is(PolicyId::no_intervention, 20.0, "c")})
                    .has_value());
  }
  ReadBank bank = read_bank(folder.file("bank")).value();
  const Thinning thinning = thin(bank, 1).value();
  EXPECT_EQ(thinning.forgotten, 1U);
  EXPECT_EQ(thinning.left, 2U) << "nothing speaks for what c speaks for";
  EXPECT_EQ(bank.store.size(), 2U);
  EXPECT_FALSE(bank.store.find(2).value()) << "of two alike the newer goes";
  EXPECT_EQ(text_of(Thinning{"bank", 1, 2, 1}),
            "bank: 1 cases forgotten, 2 left: nothing else is stood for by another\n");
  EXPECT_EQ(text_of(Thinning{"bank", 0, 2, 2}), "bank: 0 cases forgotten, 2 left\n");
}

TEST(Thinning, KeepsWhatSomebodyHasLearntOfMeanwhile) {
  const EmptyFolder folder;
  memory::Store store = open_to_add(folder.file("bank")).value();
  ASSERT_TRUE(store
                  .add_all(std::vector{best_is(PolicyId::aeb, 10.0, "a"),
                                       best_is(PolicyId::aeb, 10.1, "b")})
                  .has_value());
  ReadBank bank = read_bank(folder.file("bank")).value();
  const auto learns = [](memory::Case& one) {
    ++one.count;
    return true;
  };
  ASSERT_FALSE(store.change(2, learns));
  const Thinning thinning = thin(bank, 1).value();
  EXPECT_EQ(thinning.forgotten, 0U);
  EXPECT_EQ(thinning.changed, 1U);
  EXPECT_EQ(thinning.left, 2U);
  EXPECT_EQ(bank.store.find(2).value().value().count, 2);
  EXPECT_EQ(text_of(thinning),
            folder.file("bank") +
                ": 0 cases forgotten, 2 left, 1 of them since somebody learnt of them meanwhile\n");
}

}  // namespace
}  // namespace saca::banks::bank_changes_test
