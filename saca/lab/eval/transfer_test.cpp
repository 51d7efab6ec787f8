#include "saca/lab/eval/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/onboard/match/example_scenes.h"

namespace saca::eval::transfer_test {
namespace {

using manoeuvre::PolicyId;
using memory::Case;

/// At this speed one policy harms nobody, told and in truth; every other harms by 0.1.
Case best_is(PolicyId policy, double speed, const std::string& source) {
  Case one;
  one.scene = match::empty_road();
  one.scene.ego.v_B.x = speed;
  one.best = policy;
  one.source = source;
  one.told.emplace();
  for (std::optional<double>& harm : *one.told) {
    harm = 0.1;
  }
  one.told->at(manoeuvre::index(policy)) = 0.0;
  one.happened = one.told;
  return one;
}

TEST(Transfers, HoldWhereTheQueryIsLikeTheCases) {
  const std::vector<Case> cases{best_is(PolicyId::aeb, 10.0, "a"),
                                best_is(PolicyId::aes_left, 20.0, "b")};
  std::vector<Case> queries{best_is(PolicyId::aeb, 10.0, "c"),
                            best_is(PolicyId::aes_right, 20.0, "d"),
                            best_is(PolicyId::aes_left, 20.0, "e")};
  (*queries[2].told)[manoeuvre::index(PolicyId::aes_left)] = 0.3;
  const auto found = transfers(cases, queries, 1, 2);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_TRUE(found[0].in_truth && found[0].as_told && found[0].braking);
  EXPECT_NEAR(found[0].share, 1.0 / 1.3, 1e-9);  // the other case weighs next to nothing
  EXPECT_FALSE(found[1].in_truth || found[1].as_told || found[1].braking);
  EXPECT_TRUE(found[2].in_truth);
  EXPECT_FALSE(found[2].as_told);
  EXPECT_EQ(transfers(cases, queries, 1, 1)[1].random_one, found[1].random_one);
}

TEST(Transfers, LeaveOutTheSameEncounterAndItsTwin) {
  const std::vector<Case> cases{best_is(PolicyId::aeb, 10.0, "a"),
                                best_is(PolicyId::aeb, 10.0, "a_twin"),
                                best_is(PolicyId::aes_left, 10.7, "b")};
  const auto found = transfers(cases, cases, 1, 1);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FALSE(found[0].in_truth);
  EXPECT_FALSE(found[1].in_truth);
  EXPECT_FALSE(found[2].in_truth);
  std::vector<Case> nameless = cases;
  for (Case& one : nameless) {
    one.source.clear();
  }
  EXPECT_TRUE(transfers(nameless, nameless, 1, 1)[0].in_truth)
      << "nobody knows that it is the same";
}

TEST(Transfers, AreOfWhatIsKnownAndMatters) {
  const std::vector<Case> cases{best_is(PolicyId::aeb, 10.0, "a")};
  Case alike = best_is(PolicyId::aeb, 10.0, "b");
  for (std::optional<double>& harm : *alike.happened) {
    harm = 0.001;
  }
  Case untold = best_is(PolicyId::aeb, 10.0, "c");
  untold.told.reset();
  Case unhappened = best_is(PolicyId::aeb, 10.0, "d");
  unhappened.happened.reset();
  const std::vector<Case> queries{alike, untold, unhappened};
  EXPECT_TRUE(transfers(cases, queries, 1, 1).empty());
  EXPECT_THROW((void)transfers({}, queries, 1, 1), ContractViolation);
}

std::vector<Transfer> falling() {
  std::vector<Transfer> all(10);
  for (int i = 0; i < 10; ++i) {  // by share: good, good, good, good, bad, good, bad, bad, bad, bad
    all[static_cast<std::size_t>(i)] = {.share = 1.0 - 0.1 * i, .in_truth = i < 4 || i == 5};
  }
  return all;
}

TEST(LeastShare, IsWhereThePartStillHoldsOfAllAbove) {
  EXPECT_NEAR(least_share(falling(), 1.0).value(), 0.7, 1e-12);
  EXPECT_NEAR(least_share(falling(), 0.8).value(), 0.5, 1e-12);  // 4 of 5, then 5 of 6
  EXPECT_NEAR(least_share(falling(), 0.5).value(), 0.1, 1e-12);
  std::vector<Transfer> bad(3);
  EXPECT_FALSE(least_share(bad, 0.5).has_value());
  bad[0].in_truth = true;  // as sure as the others: it cannot be told from them
  EXPECT_FALSE(least_share(bad, 0.5).has_value());
  EXPECT_FALSE(least_share({}, 0.5).has_value());
}

TEST(TransferFigures, CountByConfidence) {
  const auto all = falling();
  const TransferFigures whole = transfer_figures(all, -1.0, 1.0);
  EXPECT_EQ(whole.in_truth.of, 10);
  EXPECT_EQ(whole.in_truth.count, 5);
  EXPECT_EQ(whole.coverage, 1.0);
  const double middle = memory::confidence_at(0.5);
  const TransferFigures upper = transfer_figures(all, middle, 1.0);
  EXPECT_EQ(upper.in_truth.of, 5);
  EXPECT_EQ(upper.in_truth.count, 4);
  EXPECT_EQ(upper.coverage, 0.5);
  EXPECT_EQ(transfer_figures({}, 0.0, 1.0).coverage, 0.0);
}

// Clopper and Pearson: of none of 10, 1 - 0.025^(1/10) at most.
TEST(TheIntervalOfAShare, IsExact) {
  EXPECT_EQ(interval_of({0, 10}).low, 0.0);
  EXPECT_NEAR(interval_of({0, 10}).high, 1.0 - std::pow(0.025, 0.1), 1e-9);
  EXPECT_NEAR(interval_of({10, 10}).low, std::pow(0.025, 0.1), 1e-9);
  EXPECT_EQ(interval_of({10, 10}).high, 1.0);
}

}  // namespace
}  // namespace saca::eval::transfer_test
