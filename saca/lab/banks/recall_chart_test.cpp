#include "saca/lab/banks/recall_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::banks::recall_chart_test {
namespace {

using testing::HasSubstr;
using testing::Not;

RecallCalibration one_query() {
  return {.file = "folder/cases.jsonl",
          .num_cases = 2,
          .seed = 1,
          .within = {{.share = 0.8, .in_truth = true}},
          .check_files = "check.jsonl",
          .checks = std::nullopt};
}

TEST(RecallChart, IsOfTheCasesThemselvesWhereNothingIsChecked) {
  const std::string picture = recall_chart(one_query());
  EXPECT_THAT(picture, testing::StartsWith("<svg"));
  EXPECT_THAT(picture, HasSubstr("How often what is recalled holds"));
  EXPECT_THAT(picture, HasSubstr(">cases.jsonl: 1 scenes in which the choice matters<"));
  EXPECT_THAT(picture, HasSubstr("as good as the best, in truth"));
}

TEST(RecallChart, IsOfWhatIsCheckedElse) {
  RecallCalibration calibration = one_query();
  calibration.checks.emplace();
  const std::string empty = recall_chart(calibration);
  EXPECT_THAT(empty, HasSubstr(">check.jsonl: 0 scenes in which the choice matters<"));
  EXPECT_THAT(empty, Not(HasSubstr(">cases.jsonl")));
  calibration.checks->push_back({.share = 0.8, .in_truth = true});
  EXPECT_GT(recall_chart(calibration).size(), empty.size()) << "a tenth with recalls has a point";
}

}  // namespace
}  // namespace saca::banks::recall_chart_test
