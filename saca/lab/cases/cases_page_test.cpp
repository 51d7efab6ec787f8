#include "saca/lab/cases/cases_page.h"

#include <gmock/gmock.h>

#include "saca/lab/cases/cases_for_test.h"

namespace saca::cases::cases_page_test {
namespace {

using testing::ElementsAre;

/// Ten from behind, and one of those who cross.
std::vector<CrashCase> eleven_cases() {
  std::vector<CrashCase> cases;
  for (int i = 0; i < 10; ++i) {
    cases.push_back(case_by_hand("fars_" + std::to_string(i)));
  }
  cases.push_back(case_by_hand("fars_10"));
  cases.back().family = "crossing";
  cases.back().judged.one.best = manoeuvre::PolicyId::aes_left;
  return cases;
}

TEST(CasesPage, SoManyAreDrawnInTheOrderOfTheFile) {
  const auto shown = shown_cases(eleven_cases(), {.file = "a.jsonl", .count = 4}).value();
  ASSERT_EQ(shown.size(), 4U);
  for (std::size_t i = 1; i < shown.size(); ++i) {
    EXPECT_LT(std::stoi(shown[i - 1].record.name.substr(5)),
              std::stoi(shown[i].record.name.substr(5)));
  }
  EXPECT_EQ(shown_cases(eleven_cases(), {.file = "a.jsonl"}).value().size(), 11U)
      << "no more than there are";
}

TEST(CasesPage, OneFamilyOrRecordCanBeAskedFor) {
  const auto crossing = shown_cases(eleven_cases(), {.file = "a", .family = "crossing"}).value();
  ASSERT_EQ(crossing.size(), 1U);
  EXPECT_EQ(crossing[0].record.name, "fars_10");
  EXPECT_EQ(shown_cases(eleven_cases(), {.file = "a", .record = "fars_3"}).value().size(), 1U);
  EXPECT_EQ(shown_cases(eleven_cases(), {.file = "a", .family = "ramp", .record = "fars_3"})
                .error()
                .message,
            "a: want cases of the family ramp of the record fars_3, got none of 11");
}

TEST(CasesPage, CountsFamiliesAndTheirBest) {
  const report::PageTable table = cases_table(eleven_cases());
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].name, "crossing");
  EXPECT_EQ(table.rows[1].name, "rear_end");
  EXPECT_EQ(table.columns.size(), table.rows[0].cells.size());
  EXPECT_EQ(table.columns.at(1), "AEB");
  EXPECT_EQ(table.rows[1].cells.at(0), "10");
  EXPECT_EQ(table.rows[1].cells.at(1), "10");
  EXPECT_EQ(table.rows[0].cells.at(1), "0");
}

TEST(CasesPage, HasACardOfEachAndSaysHowItIsMadeAgain) {
  const ShownOptions options{.file = "a.jsonl", .record = "fars_3", .count = 5, .seed = 2};
  const std::vector<CrashCase> all = eleven_cases();
  const auto shown = shown_cases(all, options).value();
  const auto page = cases_page(shown, all, options, shipped().tools());
  ASSERT_TRUE(page.has_value()) << page.error().message;
  EXPECT_EQ(page.value().gallery.size(), 1U);
  EXPECT_THAT(page.value().lines.at(0), testing::StartsWith("1 of 11 cases, drawn with seed 2."));
  EXPECT_THAT(page.value().footnotes,
              ElementsAre("saca cases show a.jsonl --count 5 --seed 2 --record fars_3"));
  std::vector<CrashCase> spoilt = shown;
  spoilt[0].kind = "no_such";
  EXPECT_FALSE(cases_page(spoilt, all, options, shipped().tools()).has_value());
}

TEST(CasesPage, IsToldToPrograms) {
  EXPECT_EQ(cases_page_json({case_by_hand("fars_1")}, "a.jsonl", "b.html", 11),
            (nlohmann::json{{"schema", "saca.cases_page/1"},
                            {"file", "a.jsonl"},
                            {"page", "b.html"},
                            {"cases", 11},
                            {"shown", {"fars_1"}}}));
}

}  // namespace
}  // namespace saca::cases::cases_page_test
