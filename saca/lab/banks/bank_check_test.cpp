#include "saca/lab/banks/bank_check.h"

#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/trigger_case.h"

namespace saca::banks::bank_check_test {
namespace {

using manoeuvre::PolicyId;
using memory::Trust;

/// A bank with what an encounter teaches in which only the left helps, as it came from elsewhere.
class BankCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    const scenario::Scenario scenario = eval::only_left_helps();
    right_ = eval::case_at_trigger({&scenario, &car_, &harm_, tools_.intent, {}, {}},
                                   tools_.forecast, tools_.draws, tools_.made_with)
                 .value()
                 .value();
    right_.trust = Trust::unchecked;
    wrong_ = right_;
    wrong_.source = "somebody who errs";
    wrong_.best = PolicyId::no_intervention;
    wrong_.told.reset();
    wrong_.happened.reset();
    memory::Store store = open_to_add(folder_.file("bank")).value();
    ASSERT_TRUE(store.add_all(std::vector{right_, wrong_}).has_value());
  }

  [[nodiscard]] BankCheck check_bank(Quarantined quarantined) {
    ReadBank bank = read_bank(folder_.file("bank")).value();
    return check(bank, tools_, {quarantined, 2, long_work::ProgressDisplay::silent}).value();
  }
  [[nodiscard]] Trust trust_of(std::size_t i) const {
    return read_bank(folder_.file("bank")).value().cases.at(i).trust;
  }

  EmptyFolder folder_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  CaseTools tools_{.forecast = {&car_, &harm_},
                   .intent = &intent::shipped_model(),
                   .made_with = encounter::made_with({&car_, &harm_}, intent::shipped_model(), "c"),
                   .draws = 16};
  memory::Case right_;
  memory::Case wrong_;
};

TEST_F(BankCheckTest, TrustsWhatHoldsAndQuarantinesWhatDoesNot) {
  const BankCheck first = check_bank(Quarantined::left_alone);
  EXPECT_EQ(first.bank, folder_.file("bank"));
  EXPECT_EQ(first.confirmed, 1);
  EXPECT_EQ(first.open, 0);
  EXPECT_EQ(first.refuted, 1);
  EXPECT_EQ(trust_of(0), Trust::trusted);
  EXPECT_EQ(trust_of(1), Trust::quarantined);
  const BankCheck again = check_bank(Quarantined::left_alone);
  EXPECT_EQ(again.confirmed + again.open + again.refuted, 0) << "all of it is known by now";
}

TEST_F(BankCheckTest, LooksAtTheQuarantinedWhereThatIsWanted) {
  (void)check_bank(Quarantined::left_alone);
  const BankCheck again = check_bank(Quarantined::checked_too);
  EXPECT_EQ(again.confirmed + again.open + again.refuted, 1);
}

TEST_F(BankCheckTest, WhatThisCarTrustsIsNotCheckedButAnotherCarsIs) {
  memory::Case own = right_;
  own.trust = Trust::trusted;
  own.made_with = tools_.made_with;
  memory::Case foreign = own;
  for (memory::MadeWith& thing : foreign.made_with) {
    thing.digest = "another";
  }
  foreign.source = "another car";
  memory::Case banned = own;
  banned.trust = Trust::quarantined;
  const std::vector all{own, foreign, banned, right_};
  const auto usual = cases_to_check(all, tools_, Quarantined::left_alone);
  ASSERT_EQ(usual.size(), 2U);
  EXPECT_EQ(usual[0].source, "another car");
  EXPECT_EQ(usual[1].trust, Trust::unchecked);
  EXPECT_EQ(cases_to_check(all, tools_, Quarantined::checked_too).size(), 3U);
}

// What one car has found out is of no less worth to it because another goes otherwise.
TEST_F(BankCheckTest, LeavesWhatAnotherCarTrustsAndAddsOneOfItsOwn) {
  std::vector theirs{right_, wrong_};
  for (memory::Case& one : theirs) {
    one.trust = Trust::trusted;
    one.origin = memory::Origin::own;
    for (memory::MadeWith& thing : one.made_with) {
      thing.digest = "another";
    }
  }
  const std::string file = folder_.file("theirs");
  ASSERT_TRUE(open_to_add(file).value().add_all(theirs).has_value());
  const auto check_theirs = [&] {
    ReadBank bank = read_bank(file).value();
    return check(bank, tools_, {Quarantined::checked_too, 2, long_work::ProgressDisplay::silent})
        .value();
  };
  const std::vector<memory::Case> before = read_bank(file).value().cases;
  const BankCheck first = check_theirs();
  EXPECT_EQ(first.added, 1);
  EXPECT_EQ(first.refuted_for_this, 1);
  EXPECT_EQ(first.confirmed + first.open + first.refuted, 0);
  const std::vector<memory::Case> after = read_bank(file).value().cases;
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(memory::to_json(after[0]), memory::to_json(before[0])) << "with what happened";
  EXPECT_EQ(memory::to_json(after[1]), memory::to_json(before[1])) << "still trusted by that car";
  EXPECT_EQ(after[2].source, right_.source);
  EXPECT_EQ(after[2].trust, Trust::trusted);
  EXPECT_EQ(after[2].made_with, tools_.made_with);
  EXPECT_TRUE(after[2].told);
  EXPECT_FALSE(after[2].happened) << "that was another car";
  EXPECT_EQ(after[2].origin, memory::Origin::simulation) << "this car has not driven it";
  EXPECT_EQ(check_theirs().added, 0) << "it has one already";
  EXPECT_EQ(read_bank(file).value().cases.size(), 3U);
}

TEST(BankCheck, IsToldToProgramsAndPeople) {
  const BankCheck check{.bank = "bank", .confirmed = 4, .open = 2, .refuted = 1};
  EXPECT_EQ(json_of(check, "small_fwd_car"),
            nlohmann::json::parse(R"({"schema": "saca.memory_check/1", "file": "bank",
                "car": "small_fwd_car", "confirmed": 4, "open": 2, "refuted": 1,
                "added": 0, "refuted_for_this_car": 0})"));
  EXPECT_EQ(text_of(check),
            "bank: 4 cases confirmed and trusted, 2 stay as they were, 1 refuted and "
            "quarantined\n");
  EXPECT_EQ(
      text_of(BankCheck{.bank = "bank", .open = 2, .added = 3, .refuted_for_this = 1}),
      "bank: 0 cases confirmed and trusted, 2 stay as they were, 0 refuted and quarantined; of "
      "those that another car trusts, which stay, 3 are confirmed and added for this car, 1 "
      "refuted for it\n");
}

}  // namespace
}  // namespace saca::banks::bank_check_test
