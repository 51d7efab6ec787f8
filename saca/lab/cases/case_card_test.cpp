#include "saca/lab/cases/case_card.h"

#include <gmock/gmock.h>

#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::case_card_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::HasSubstr;

TEST(CaseCard, ShowsTheCrashAndTheBestPlan) {
  const CrashCase one = case_by_hand();
  const report::GalleryCard card = case_card(one, shipped().tools()).value();
  EXPECT_EQ(card.title, "FARS Arizona 2016, ST_CASE 40001: rear_end, highway");
  ASSERT_EQ(card.lines.size(), 2U);
  EXPECT_THAT(card.lines[0], HasSubstr("the ego's front (as recorded)."));
  EXPECT_THAT(card.lines[1], HasSubstr("best over the draws: 0 AEB"));
  EXPECT_EQ(card.done.title, "Without avoidance");
  EXPECT_EQ(card.done.policy, PolicyId::no_intervention);
  EXPECT_FALSE(card.done.contacts.empty()) << "it happens without avoidance";
  EXPECT_EQ(card.best.policy, PolicyId::aeb);
}

TEST(CaseCard, HasHarmsFactsAndAssumptions) {
  const CrashCase one = case_by_hand();
  const report::GalleryCard card = case_card(one, shipped().tools()).value();
  const report::PageTable& harms = card.tables.at(0);
  EXPECT_THAT(harms.lines.at(0), HasSubstr("over 4 draws"));
  EXPECT_THAT(harms.lines.at(0), HasSubstr("1 of 2 plans are admissible (at most 0.2520)"));
  ASSERT_EQ(harms.rows.size(), 5U);
  const std::size_t aeb = index(PolicyId::aeb);
  EXPECT_EQ(harms.rows[0].cells.at(aeb), "0.2500") << "expected";
  EXPECT_EQ(harms.rows[1].cells.at(aeb), "0.2000") << "over draws";
  EXPECT_EQ(harms.rows[2].cells.at(aeb), "0.000 to 0.300") << "no harm is below 0";
  EXPECT_EQ(harms.rows[3].cells.at(aeb), "75 %");
  EXPECT_EQ(harms.rows[4].cells.at(aeb), "1");
  EXPECT_EQ(harms.rows[1].cells.at(index(PolicyId::aes_left)), "-");
  ASSERT_EQ(card.folded.size(), 2U);
  EXPECT_THAT(card.folded[0].rows.at(1).cells, testing::ElementsAre("crash", "-", "not known"));
  EXPECT_THAT(card.folded[1].heading,
              HasSubstr("1 of " + std::to_string(one.ranges.size()) + " numbers are recorded"));
}

// Of a recording nothing can be drawn: it shows what was perceived.
TEST(CaseCard, OfARecordingShowsWhatWasPerceived) {
  CrashCase one = case_by_hand();
  one.record = {.study = "100-Car", .name = "hundred_car_8463", .number = 8463};
  one.family = "100car";
  one.place.reset();
  one.kind.reset();
  one.ranges.clear();
  one.without.reset();
  const report::GalleryCard card = case_card(one, shipped().tools()).value();
  EXPECT_EQ(card.title, "100-Car, event 8463: 100car");
  EXPECT_EQ(card.lines.at(0), "Without avoidance nobody is met.");
  EXPECT_EQ(card.done.title, "Without avoidance, all going on");
  EXPECT_EQ(card.folded.size(), 1U) << "nothing was assumed";
}

TEST(CaseCard, SaysWhatCannotBeDrawn) {
  CrashCase one = case_by_hand();
  one.kind = "no_such";
  EXPECT_THAT(case_card(one, shipped().tools()).error().message, HasSubstr("no_such"));
}

}  // namespace
}  // namespace saca::cases::case_card_test
