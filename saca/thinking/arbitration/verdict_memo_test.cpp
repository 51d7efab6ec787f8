#include "saca/thinking/arbitration/verdict_memo.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::arbitration::verdict_memo_test {
namespace {

using world::Scene;

class VerdictMemoTest : public ::testing::Test {
 protected:
  /// Counts how often it is asked, and says so as its verdict's time.
  Judge counting() {
    return [this](const auto&...) { return reflex::Verdict{.time = 1.0 * ++asked_}; };
  }
  int asked_ = 0;
  Scene scene_ = test::ego_at(15.0);
  intent::Beliefs beliefs_;
};

TEST_F(VerdictMemoTest, EqualArgumentsAreJudgedOnce) {
  const Judge judge = memoised(counting());
  const reflex::UnderWay braking{
      .plan = manoeuvre::full_braking, .begun = 0.5, .ego = {}, .road = {}};
  EXPECT_EQ(judge(scene_, beliefs_, std::nullopt).time, 1.0);
  EXPECT_EQ(judge(scene_, beliefs_, braking).time, 2.0);
  EXPECT_EQ(judge(scene_, beliefs_, std::nullopt).time, 1.0);
  EXPECT_EQ(judge(scene_, beliefs_, braking).time, 2.0);
  EXPECT_EQ(asked_, 2);
}

TEST_F(VerdictMemoTest, WhateverDiffersIsJudgedAnew) {
  const Judge judge = memoised(counting());
  Scene other = scene_;
  other.actors.push_back({.id = 1, .mass = 1'500.0});
  intent::Beliefs maintains;
  maintains.push_back({});
  intent::Beliefs brakes = maintains;
  brakes[0].at[2][intent::all_intentions.size() - 1] = 1.0;
  (void)judge(scene_, beliefs_, std::nullopt);
  (void)judge(other, maintains, std::nullopt);
  (void)judge(other, brakes, std::nullopt);
  other.actors[0].a_W.y = 1e-9;
  (void)judge(other, brakes, std::nullopt);
  reflex::UnderWay under_way{.plan = manoeuvre::full_braking, .begun = 0.5, .ego = {}, .road = {}};
  (void)judge(other, brakes, under_way);
  under_way.grip = 0.8;
  (void)judge(other, brakes, under_way);
  EXPECT_EQ(asked_, 6);
}

TEST_F(VerdictMemoTest, CopiesShareWhatTheyKnow) {
  const Judge judge = memoised(counting());
  const Judge copy = judge;  // NOLINT(performance-unnecessary-copy-initialization): what is tested
  (void)judge(scene_, beliefs_, std::nullopt);
  EXPECT_EQ(copy(scene_, beliefs_, std::nullopt).time, 1.0);
}

TEST_F(VerdictMemoTest, WhoThrewIsAskedAgain) {
  const Judge judge = memoised([this](const auto&...) -> reflex::Verdict {
    if (++asked_ == 1) {
      throw std::runtime_error("out of memory");
    }
    return {.time = 7.0};
  });
  EXPECT_THROW((void)judge(scene_, beliefs_, std::nullopt), std::runtime_error);
  EXPECT_EQ(judge(scene_, beliefs_, std::nullopt).time, 7.0);
}

TEST_F(VerdictMemoTest, WantsAJudge) {
  EXPECT_THROW((void)memoised({}), ContractViolation);
}

}  // namespace
}  // namespace saca::arbitration::verdict_memo_test
