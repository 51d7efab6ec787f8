#include "saca/thinking/memory/learning.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "saca/onboard/match/example_scenes.h"

namespace saca::memory::learning_test {
namespace {

using manoeuvre::PolicyId;

Case with_harms(PolicyHarms happened) {
  Case one;
  one.scene = match::empty_road();
  one.happened = happened;
  return one;
}

TEST(Contradiction, IsToSpeakForNothingInCommon) {
  const Case aeb = with_harms({0.0, 0.3, 0.3});
  const Case left = with_harms({0.3, 0.0, 0.3});
  const Case either = with_harms({0.0, 0.0, 0.3});
  EXPECT_TRUE(contradict(aeb, left));
  EXPECT_TRUE(contradict(left, aeb));
  EXPECT_FALSE(contradict(aeb, either));
  EXPECT_FALSE(contradict(aeb, aeb));
  EXPECT_FALSE(contradict(aeb, with_harms({}))) << "it speaks for nothing";
}

TEST(AMergedCase, IsInRangeWhateverItIsMergedOf) {
  Case much = with_harms({1e308});
  much.harm = much.best_harm = much.collision_loss = 1.7e308;
  much.count = std::numeric_limits<int>::max();
  const Case one = merged(much, much);
  EXPECT_FALSE(broken_rule(one));
  EXPECT_EQ(one.count, std::numeric_limits<int>::max());
  EXPECT_FALSE(broken_rule(merged(one, with_harms({0.1}))));
  EXPECT_FALSE(broken_rule(merged(with_harms({0.1}), one)));
}

TEST(AMergedCase, TakesNoFiguresOfHearsay) {
  Case known = with_harms({0.2, 0.1});
  known.id = 3;
  known.count = 4;
  known.harm = 0.4;
  Case said;
  said.scene = match::empty_road();
  said.origin = Origin::expert;
  said.trust = Trust::unchecked;
  said.best = PolicyId::aes_left;
  said.id = 8;
  ASSERT_TRUE(is_hearsay(said));
  ASSERT_FALSE(is_hearsay(known));
  const Case one = merged(known, said);
  EXPECT_EQ(one.harm, 0.4);
  EXPECT_EQ(one.count, 4);
  EXPECT_EQ(one.id, 3);
  const Case other = merged(said, known);
  EXPECT_EQ(other.harm, 0.4);
  EXPECT_EQ(other.happened, known.happened);
  EXPECT_EQ(other.id, 8);
  EXPECT_EQ(other.trust, Trust::unchecked);
  EXPECT_EQ(merged(said, said).best, PolicyId::aes_left);
}

// A check of an expert's word says what is expected, but nobody has met that encounter.
TEST(AMergedCase, TakesOfHearsayWhatACheckTold) {
  Case known = with_harms({0.2, 0.1});
  known.count = 2;
  known.harm = 0.4;
  Case said;
  said.scene = match::empty_road();
  said.origin = Origin::expert;
  said.best = PolicyId::aes_left;
  said.told = PolicyHarms{0.3, 0.0};
  for (const Case& one : {merged(known, said), merged(said, known)}) {
    EXPECT_EQ(one.count, 2);
    EXPECT_EQ(one.harm, 0.4) << "no encounter without harm was met";
    EXPECT_EQ(one.happened, known.happened);
    EXPECT_EQ(one.told, said.told);
  }
  known.told = PolicyHarms{0.5, 0.1};
  EXPECT_EQ(merged(known, said).told, known.told);
  EXPECT_EQ(merged(said, known).told, known.told);
}

// Else the car's own drive could be forgotten with the shipped case that it is the same as.
TEST(AMergedCase, IsTheCarsOwnWhereEitherIs) {
  Case shipped = with_harms({0.2, 0.1});
  shipped.origin = Origin::simulation;
  Case own = shipped;
  own.origin = Origin::own;
  Case recorded = shipped;
  recorded.origin = Origin::recording;
  EXPECT_EQ(merged(shipped, own).origin, Origin::own);
  EXPECT_EQ(merged(own, shipped).origin, Origin::own);
  EXPECT_EQ(merged(shipped, recorded).origin, Origin::simulation);
}

TEST(Lessons, AreTheNewestOfMany) {
  Case one;
  for (std::size_t i = 0; i <= most_texts; ++i) {
    const std::string text = std::to_string(i);
    add_lessons(one, {&text, 1});
  }
  EXPECT_FALSE(broken_rule(one));
  EXPECT_EQ(one.lessons.front(), "1");
  EXPECT_EQ(one.lessons.back(), std::to_string(most_texts));
}

TEST(AMergedCase, IsTheMeanOfAsManyEncountersAsEachStandsFor) {
  Case older = with_harms({0.2, 0.1, std::nullopt});
  older.id = 7;
  older.count = 3;
  older.harm = 0.4;
  older.best_harm = 0.1;
  older.collision_loss = 1.0;
  older.told = PolicyHarms{0.5};
  older.lessons = {"first"};
  older.trust = Trust::unchecked;
  older.best = PolicyId::aes_left;
  Case newer = with_harms({0.6, 0.3, 0.7});
  newer.id = 9;
  newer.harm = 0.8;
  newer.best_harm = 0.3;
  newer.collision_loss = 5.0;
  newer.lessons = {"second"};
  newer.best = PolicyId::aes_left;
  const Case one = merged(older, newer);
  EXPECT_EQ(one.id, 7);
  EXPECT_EQ(one.count, 4);
  EXPECT_EQ(one.trust, Trust::unchecked);
  EXPECT_DOUBLE_EQ(one.harm, (3 * 0.4 + 0.8) / 4);
  EXPECT_DOUBLE_EQ(one.best_harm, (3 * 0.1 + 0.3) / 4);
  EXPECT_DOUBLE_EQ(one.collision_loss, 2.0);
  EXPECT_EQ(one.worst_harm, 0.8);
  EXPECT_DOUBLE_EQ((*one.happened)[0].value(), 0.3);
  EXPECT_DOUBLE_EQ((*one.happened)[1].value(), 0.15);
  EXPECT_EQ((*one.happened)[2], 0.7) << "known of one only";
  EXPECT_EQ(one.told, older.told) << "likewise";
  EXPECT_EQ(one.lessons, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(one.best, PolicyId::aes_left);
  EXPECT_FALSE(broken_rule(one).has_value());
}

TEST(AMergedCase, KeepsTheNewestLessons) {
  Case older = with_harms({});
  older.lessons.assign(most_texts, "old");
  Case newer = with_harms({});
  newer.lessons = {"new"};
  const Case one = merged(older, newer);
  EXPECT_EQ(one.lessons.size(), most_texts);
  EXPECT_EQ(one.lessons.back(), "new");
}

TEST(AMergedCase, KeepsTheWorstOfAll) {
  Case older = with_harms({});
  older.worst_harm = 0.9;
  older.harm = 0.1;
  Case newer = with_harms({});
  newer.harm = 0.5;
  EXPECT_EQ(merged(older, newer).worst_harm, 0.9);
  EXPECT_EQ(merged(newer, older).worst_harm, 0.9);
}

TEST(AMergedCase, HasTheBestOfItsMeans) {
  Case older = with_harms({0.10, 0.00, 0.20});
  older.best = PolicyId::aes_left;
  Case newer = with_harms({0.00, 0.30, 0.20});
  newer.best = PolicyId::aeb;
  EXPECT_EQ(merged(older, newer).best, PolicyId::aeb);  // 0.05, 0.15, 0.2
  newer = with_harms({0.50, 0.50, 0.00});
  newer.best = PolicyId::aeb;
  EXPECT_EQ(merged(older, newer).best, PolicyId::aes_right);  // 0.3, 0.25, 0.1
}

}  // namespace
}  // namespace saca::memory::learning_test
