#include "saca/lab/cases/case_making.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/lab/cases/cases_for_test.h"
#include "saca/lab/crash_records/record_family.h"
#include "saca/lab/crash_records/records_for_test.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::cases::case_making_test {
namespace {

using testing::HasSubstr;

TEST(CaseRowTest, ComesBackFromItsLine) {
  const CaseRow nothing{
      .family = "crossing", .end = CrashEnd::never_triggers, .problem = "no such car"};
  const CaseRow back = case_row_from(case_row_line(nothing)).value();
  EXPECT_EQ(back.family, "crossing");
  EXPECT_EQ(back.end, CrashEnd::never_triggers);
  EXPECT_EQ(back.problem, "no such car");
  EXPECT_FALSE(back.made.has_value());

  const CaseRow made{.family = "rear_end", .end = CrashEnd::happens, .made = case_by_hand()};
  EXPECT_EQ(case_row_line(case_row_from(case_row_line(made)).value()), case_row_line(made));
}

TEST(CaseRowTest, RefusesWhatIsNoLineOfOne) {
  const auto complaint = [](const std::string& line) {
    return case_row_from(line).error().message;
  };
  EXPECT_FALSE(case_row_from("{\"family\":").has_value());
  EXPECT_THAT(complaint(R"({"family":"a","end":"ends","problem":"","case":null})"),
              HasSubstr("how a search ended"));
  EXPECT_THAT(complaint(R"({"family":"a","end":"happens","problem":"","case":{}})"),
              HasSubstr("is missing"));
  EXPECT_THAT(complaint(R"({"family":"a","end":"happens","problem":"","case":null,"more":1})"),
              HasSubstr("more"));
}

/// A car that ran into a slower one; the side that is hit is the front of the ego.
CaseSources slower_ahead_alone() {
  CaseSources sources{.release = {.crashes = {crash_records::slower_ahead()}, .notes = {}},
                      .codes = crash_records::shipped_codes(),
                      .prospects = {},
                      .counts = {},
                      .events = {}};
  const crash_records::FarsCrash& crash = sources.release.crashes[0];
  const auto roles = std::get<crash_records::Roles>(crash_records::roles_of(crash, sources.codes));
  const auto base = crash_records::load_base_families("scenarios/families").value();
  sources.prospects.push_back(
      {.crash = 0,
       .roles = roles,
       .family = crash_records::family_of(crash, roles, sources.codes, base).value()});
  return sources;
}

const CaseMakingOptions quick{
    .seed = 1, .judging = {.told_draws = 2, .draws = 2, .seed = 9}, .tries = 20};

TEST(CaseMakingTest, MakesOfARecordWhatWasRecorded) {
  const CaseSources sources = slower_ahead_alone();
  const CaseMaking making(quick, sources, shipped().tools());
  ASSERT_EQ(making.size(), 1U);
  const CaseRow row = making.row(0);
  EXPECT_EQ(row.family, "rear_end");
  EXPECT_EQ(row.end, CrashEnd::happens);
  EXPECT_EQ(row.problem, "");
  ASSERT_TRUE(row.made.has_value());
  const CrashCase& made = *row.made;
  EXPECT_EQ(made.record.name, "fars_2016_40001");
  EXPECT_EQ(made.record.number, 40001);
  EXPECT_EQ(made.kind, "slower_lead");
  EXPECT_TRUE(made.as_recorded);
  EXPECT_EQ(made.impact_agrees, true) << "12 o'clock is the front";
  EXPECT_TRUE(made.without->first_actor);
  EXPECT_FALSE(made.ranges.empty());
  EXPECT_EQ(made.judged.one.draws, 2);
  EXPECT_EQ(case_row_line(making.row(0)), case_row_line(row)) << "the same again";
}

TEST(CaseMakingTest, DigestTellsWhatRowsDependOn) {
  const CaseSources sources = slower_ahead_alone();
  const auto digest = [&](const CaseSources& of, const std::string& car) {
    CaseTools tools = shipped().tools();
    tools.car_name = car;
    return CaseMaking(quick, of, tools).digest();
  };
  EXPECT_EQ(digest(sources, "a car"), digest(sources, "a car"));
  EXPECT_NE(digest(sources, "a car"), digest(sources, "another"));
  CaseSources other = sources;
  other.prospects[0].family.ranges.begin()->second.max += 1.0;
  EXPECT_NE(digest(sources, "a car"), digest(other, "a car"));
}

// Of a recorded emergency: a car that stands, into which the ego would run.
TEST(CaseMakingTest, MakesOfAnEventWhatWouldHaveHappened) {
  CaseSources sources{.release = {},
                      .codes = crash_records::shipped_codes(),
                      .prospects = {},
                      .counts = {},
                      .events = {}};
  scenario::Scenario scenario = eval::standing_car(20.0, 60.0);
  scenario.name = "hundred_car_8463";
  scenario.driver = "braked";
  sources.events.push_back({.event = 8463,
                            .severity = "Crash",
                            .made = importers::HundredCarImport{.scenario = scenario}});
  const CaseMaking making(quick, sources, shipped().tools());
  const CaseRow row = making.row(0);
  EXPECT_EQ(row.family, "100car");
  EXPECT_EQ(row.end, CrashEnd::happens);
  ASSERT_TRUE(row.made.has_value()) << row.problem;
  EXPECT_EQ(row.made->record.study, "100-Car");
  EXPECT_EQ(row.made->record.number, 8463);
  EXPECT_EQ(row.made->facts.at(0).words, "Crash");
  EXPECT_EQ(row.made->facts.at(1).words, "braked");
  EXPECT_FALSE(row.made->kind.has_value());
  EXPECT_EQ(row.made->grip, scenario.grip);
}

TEST(CaseMakingTest, RowsGoOnFromTheirJournal) {
  const std::filesystem::path journal =
      std::filesystem::path(testing::TempDir()) / "case_making" / "cases.journal";
  std::filesystem::remove(journal);
  const CaseSources sources = slower_ahead_alone();
  const CaseMaking making(quick, sources, shipped().tools());
  const CaseWork work{.journal = journal.string(),
                      .title = "saca cases build",
                      .display = long_work::ProgressDisplay::silent};
  const auto first = case_rows(making, work).value().value();
  const auto again = case_rows(making, work).value().value();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(case_row_line(first[0]), case_row_line(again.at(0)));
  CaseWork other = work;
  other.title = "saca cases build --seed 2";
  EXPECT_THAT(case_rows(making, other).error().message, HasSubstr("cases.journal"));
}

}  // namespace
}  // namespace saca::cases::case_making_test
