#include "saca/lab/cases/case_tally.h"

#include <gmock/gmock.h>

#include "saca/lab/cases/cases_for_test.h"
#include "saca/lab/crash_records/records_for_test.h"

namespace saca::cases::case_tally_test {
namespace {

using crash_records::CrashFamily;
using testing::HasSubstr;

// Four crashes: three from behind, of which two are worked on, and one of which none is made.
class CaseTally : public testing::Test {
 protected:
  CaseTally() {
    sources_.release.crashes.resize(4);
    sources_.release.notes = {"person.csv: 1 row is passed over"};
    CrashCount& behind = sources_.counts.at(static_cast<std::size_t>(CrashFamily::rear_end));
    behind = {.crashes = 3, .ego_is_no_car = 1};
    sources_.counts.at(static_cast<std::size_t>(CrashFamily::crossing)).crashes = 1;
    CrashCase at_once = case_by_hand("a");
    at_once.sample = 0;
    rows_ = {
        {.family = "rear_end", .end = CrashEnd::happens, .made = at_once},
        {.family = "rear_end", .end = CrashEnd::does_not_happen, .problem = "b: cannot be played"}};
    tallies_ = family_tallies(sources_, rows_);
    set_ = case_set(rows_);
  }

  CaseSources sources_{.release = {},
                       .codes = crash_records::shipped_codes(),
                       .prospects = {},
                       .counts = {},
                       .events = {}};
  std::vector<CaseRow> rows_;
  FamilyTallies tallies_;
  CaseSet set_;
};

TEST_F(CaseTally, CountsWhatBecameOfEachFamily) {
  EXPECT_EQ(tallies_.size(), crash_records::num_crash_families) << "those without a crash, too";
  const FamilyTally& behind = tallies_.at("rear_end");
  EXPECT_EQ(behind.worked_on, 2);
  EXPECT_EQ(behind.ends.at(static_cast<std::size_t>(CrashEnd::happens)), 1);
  EXPECT_EQ(behind.at_once, 1);
  EXPECT_EQ(behind.cases, 1);
  EXPECT_EQ(behind.impact_known, 1);
  EXPECT_EQ(behind.impact_agrees, 1);
}

// Keys as docs/formats.md has them.
TEST_F(CaseTally, FiguresAreOfAllAndOfEachFamily) {
  const nlohmann::json figures = tally_json(sources_, tallies_, set_);
  EXPECT_EQ(figures.at("cases.num_crashes"), 4);
  EXPECT_EQ(figures.at("cases.num_events"), 0);
  EXPECT_EQ(figures.at("cases.num_cases"), 1);
  EXPECT_EQ(figures.at("cases.num_failed"), 1);
  EXPECT_EQ(figures.at("cases.rear_end.share"), 0.75);
  EXPECT_EQ(figures.at("cases.rear_end.ego_is_no_car"), 1);
  EXPECT_EQ(figures.at("cases.rear_end.does_not_happen"), 1);
  EXPECT_EQ(figures.at("cases.rear_end.happens_at_once"), 1);
  EXPECT_EQ(figures.at("cases.ramp.num_crashes"), 0);
  EXPECT_EQ(figures.at("cases.best.AEB"), 1);
  EXPECT_EQ(figures.at("cases.best.NI"), 0);
}

TEST_F(CaseTally, NoCrashAtAllIsNoShare) {
  sources_.release.crashes.clear();
  EXPECT_EQ(tally_json(sources_, tallies_, set_).at("cases.rear_end.share"), 0.0);
}

TEST_F(CaseTally, IsToldAsATable) {
  const std::string text = tally_text(sources_, tallies_, set_, "out.jsonl");
  EXPECT_THAT(text, testing::StartsWith("note: person.csv: 1 row is passed over\nfamily  "));
  EXPECT_THAT(text,
              HasSubstr("\nrear_end            3  75.0%          2         1        1      1\n"));
  EXPECT_THAT(text, HasSubstr("\nout.jsonl: 1 cases of 4 crashes and 0 events\n"));
}

}  // namespace
}  // namespace saca::cases::case_tally_test
