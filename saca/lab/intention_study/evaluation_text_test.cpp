#include "saca/lab/intention_study/evaluation_text.h"

#include <gmock/gmock.h>

#include "saca/lab/intention_study/figures_for_test.h"

namespace saca::intention_study::evaluation_text_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(TheText, BeginsWithATableOfAllMethods) {
  const std::string text = evaluation_text(small_evaluation());
  EXPECT_THAT(text, StartsWith("\nRecorded\n                                   macro F1 now"));
  EXPECT_THAT(text,
              HasSubstr("\nours                       0.500 [0.250, 0.750]        -        - "));
  // The median of what was warned of, of how many; 8 false alarms an hour; 7 steps.
  EXPECT_THAT(text, HasSubstr("       - of 0     0.4 of 3        8        7\nother "));
}

TEST(TheText, HasOurConfusionAndActs) {
  const std::string text = evaluation_text(small_evaluation());
  EXPECT_THAT(text, HasSubstr("\nours, 0.0 s ahead: truth in rows, predicted in columns\n"));
  EXPECT_THAT(text, HasSubstr("\nours, 1.0 s ahead: truth in rows"));
  EXPECT_THAT(text, Not(HasSubstr("other, 0.0 s ahead: truth")));
  // F1 of FB: recall 1/4, precision 1/3: 2 / (4 + 3).
  EXPECT_THAT(text, HasSubstr("      FB       3       0       0       1       0       0    0.25"
                              "      0.33   0.29\n"));
  EXPECT_THAT(text, HasSubstr("      LC       0       0       0       0       0       0       -"));
  EXPECT_THAT(text, HasSubstr("\n      FB          1 of 2    0.25       -"));
}

TEST(TheText, HasDifferencesWithIntervalsOfAllButUs) {
  const std::string text = evaluation_text(small_evaluation());
  EXPECT_THAT(text, HasSubstr("ours less other, 0.0 s ahead: macro F1 +0.125 [-0.250, +0.500], "
                              "log loss -0.0625 [-0.1250, +0.0000]\n"));
  EXPECT_THAT(text, Not(HasSubstr("ours less ours")));
  EXPECT_THAT(text, Not(HasSubstr("ours less other, 1.0 s")));
}

TEST(TheText, EndsWithDisplacements) {
  const std::string text = evaluation_text(small_evaluation());
  EXPECT_THAT(text, HasSubstr("\nlane keeping                 0.00     0.00     4.00\n"));
  EXPECT_THAT(text, HasSubstr("those that brake or change lanes (1 frames)\n"
                              "constant velocity            2.00     0.00     0.00\n"));
}

}  // namespace
}  // namespace saca::intention_study::evaluation_text_test
