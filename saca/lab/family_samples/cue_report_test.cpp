#include "saca/lab/family_samples/cue_report.h"

#include <gmock/gmock.h>

namespace saca::family_samples::cue_report_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using world::CueKind;

eval::CueCounts some_counts() {
  eval::CueCounts counts{};
  counts[static_cast<std::size_t>(CueKind::parked_vans)] = {.there = 10, .came = 5};
  return counts;
}

std::vector<eval::CueForecast> some_forecasts() {
  return {{.key = "table",
           .title = "Counts by kind",
           .log_loss = {.value = 0.5, .low = 0.4, .high = 0.6, .n = 10},
           .brier = {.value = 0.25, .low = 0.2, .high = 0.3, .n = 10}},
          {.key = "law", .title = "The law", .log_loss = {}, .brier = {}}};
}

TEST(CueReport, CountsEveryKindForPrograms) {
  const json out = json_of(some_counts());
  EXPECT_EQ(out.size(), 2 * world::num_cue_kinds);
  EXPECT_EQ(out["cues.parked_vans.there"], 10);
  EXPECT_EQ(out["cues.parked_vans.came"], 5);
  EXPECT_EQ(out["cues.low_sun.there"], 0);
}

// Wilson's interval of 5 in 10 is 0.2366 to 0.7634 (any table).
TEST(CueReport, TellsPeopleOfKindsThatThereWere) {
  const std::string text = text_of(some_counts());
  EXPECT_THAT(text, HasSubstr("share (95 %)\n"));
  EXPECT_THAT(text, HasSubstr("\nparked_vans            10      5   0.500 (0.237 to 0.763)\n"));
  EXPECT_THAT(text, Not(HasSubstr("low_sun")));
}

TEST(CueReport, ForecastsHaveTheirSuite) {
  const json out = json_of("other_cues", some_forecasts());
  EXPECT_EQ(out["cues.other_cues.table.log_loss"], 0.5);
  EXPECT_EQ(out["cues.other_cues.table.log_loss.lo"], 0.4);
  EXPECT_EQ(out["cues.other_cues.table.brier.n"], 10);
  EXPECT_FALSE(out.contains("cues.other_cues.law.log_loss"));  // it counts nothing
  const std::string text = text_of("other_cues", some_forecasts());
  EXPECT_THAT(text, testing::StartsWith("\nsuite other_cues, calibration split "));
  EXPECT_THAT(text, HasSubstr("\nCounts by kind "));
  EXPECT_THAT(text, HasSubstr("0.5000 (0.4000 to 0.6000)  0.2500 (0.2000 to 0.3000)\n"));
}

}  // namespace
}  // namespace saca::family_samples::cue_report_test
