#include "saca/lab/suites/decisions.h"

#include <gmock/gmock.h>

namespace saca::suites::decisions_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Of four decisions two came from memory, one from the model, one from its rule.
eval::MethodFigures thoughtful() {
  eval::MethodFigures figures;
  figures.method = "saca";
  figures.sources = {{"", 1}, {"memory", 2}, {"model", 1}};
  figures.reasons = {{"", 3}, {"no plan", 1}};
  figures.thinking = encounter::ThinkingFigures{
      .forecasts = 8, .recalled = 2, .from_memory = 2, .asked = 4, .answered = 1};
  return figures;
}

TEST(DecisionsTable, HasSharesOfDecisionsAndOfWhatWasThought) {
  const report::PageTable table = decisions_table(thoughtful());
  EXPECT_THAT(table.heading, HasSubstr("came from"));
  EXPECT_THAT(table.columns, ElementsAre("times", "share, %"));
  const auto cells = [&](const std::string& name) {
    for (const report::PageTable::Row& row : table.rows) {
      if (row.name == name) {
        return row.cells;
      }
    }
    return std::vector<std::string>();
  };
  EXPECT_THAT(cells("source: memory"), ElementsAre("2", "50.0"));
  EXPECT_THAT(cells("source: its rule"), ElementsAre("1", "25.0"));
  EXPECT_THAT(cells("reason: no plan"), ElementsAre("1", "25.0"));
  EXPECT_THAT(cells("reason: "), ElementsAre());
  EXPECT_THAT(cells("of these, the model was asked about"), ElementsAre("4", "50.0"));
  EXPECT_THAT(cells("of those asked about, answered in time"), ElementsAre("1", "25.0"));
  EXPECT_THAT(cells("of these, false"), ElementsAre());  // no statement was made
}

TEST(Decisions, AreCountsAndRatesForPrograms) {
  json out = json::object();
  add_decisions(out, "suite.x.saca.", thoughtful());
  EXPECT_EQ(out.at("suite.x.saca.source.memory"), 2);
  EXPECT_EQ(out.at("suite.x.saca.source.none"), 1);
  EXPECT_EQ(out.at("suite.x.saca.reason.no plan"), 1);
  EXPECT_EQ(out.at("suite.x.saca.cache_hit_rate"), 0.75);
  EXPECT_EQ(out.at("suite.x.saca.memory_hit_rate"), 0.25);
  EXPECT_EQ(out.at("suite.x.saca.model_answered"), 1);
  EXPECT_EQ(out.at("suite.x.saca.statements"), 0);
}

TEST(Decisions, WhoDoesNotThinkHasOnlySources) {
  eval::MethodFigures figures;
  figures.method = "aeb";
  figures.sources = {{"", 3}};
  json out = json::object();
  add_decisions(out, "a.", figures);
  EXPECT_EQ(out, json({{"a.source.none", 3}}));
  EXPECT_EQ(decisions_text(figures), "aeb: 3 decisions: 3 from its rule");
}

TEST(DecisionsText, TellsInALine) {
  EXPECT_EQ(decisions_text(thoughtful()),
            "saca: 4 decisions: 1 from its rule, 2 from memory, 1 from model; no plan: 1; of 8 "
            "forecasts memory knew 2, the model answered 1 of the 4 that it was asked about");
}

TEST(ExpectationsText, HoldsWhatWasExpectedAgainstWhatHappened) {
  eval::MethodFigures figures;
  EXPECT_EQ(expectations_text(figures), "");
  const auto estimate = [](double value) { return eval::Estimate{.value = value, .n = 40}; };
  figures.switches = estimate(0.25);
  figures.expected = eval::ExpectedFigures{.expected = estimate(0.1),
                                           .happened = estimate(0.2),
                                           .braking_expected = estimate(0.3),
                                           .braking_happened = estimate(0.4),
                                           .knowingly_worse = estimate(0.05),
                                           .several = estimate(0.5)};
  const std::string text = expectations_text(figures);
  EXPECT_THAT(text, HasSubstr("expected 0.1000 harm of what was decided on, and 0.3000 of full"));
  EXPECT_THAT(text, HasSubstr("they harm 0.2000 and 0.4000 (40 decisions). 5.0 % were"));
  EXPECT_THAT(text, HasSubstr("In 50.0 % of all decisions"));
  EXPECT_THAT(text, HasSubstr("switched 0.25 times"));
}

}  // namespace
}  // namespace saca::suites::decisions_test
