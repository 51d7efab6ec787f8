#include "saca/lab/cases/reply_report.h"

#include <gmock/gmock.h>

namespace saca::cases::reply_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

ReplyScore score_by_hand() {
  ReplyScore score;
  score.examples = 4;
  score.known = 2;
  score.choices = {{.key = "model",
                    .title = "after reasoning",
                    .best_within = {0.5, 0.25, 0.75, 2},
                    .admissible = {1.0, 1.0, 1.0, 2},
                    .harm = {0.125, 0.0, 0.25, 2},
                    .regret = {0.0625, 0.0, 0.125, 2},
                    .above_rule = {}}};
  score.needless = {0.25, 0.0, 0.5, 2};
  score.ended = 0.75;
  score.statements = 2.5;
  score.tokens = {60, 70, 80, 90};
  return score;
}

// Keys as docs/formats.md has them.
TEST(ReplyReport, HasFiguresOfRepliesAndChoices) {
  const nlohmann::json figures = score_json(score_by_hand(), 1);
  EXPECT_EQ(figures.at("eval.num_examples"), 4);
  EXPECT_EQ(figures.at("eval.num_known"), 2);
  EXPECT_EQ(figures.at("eval.num_failed"), 1);
  EXPECT_EQ(figures.at("eval.ended"), 0.75);
  EXPECT_EQ(figures.at("eval.statements_checked"), 2.5);
  EXPECT_EQ(figures.at("eval.tokens.p50"), 80) << "of two in the middle the upper one";
  EXPECT_EQ(figures.at("eval.tokens.max"), 90);
  EXPECT_EQ(figures.at("eval.twins.needless"), 0.25);
  EXPECT_EQ(figures.at("eval.model.regret.hi"), 0.125);
  EXPECT_EQ(figures.at("eval.model.harm.n"), 2);
  EXPECT_FALSE(figures.contains("eval.model.above_rule")) << "nothing counts";
  EXPECT_FALSE(figures.contains("eval.temperature"));
}

TEST(ReplyReport, ATemperatureIsToldWhereThereIsOne) {
  ReplyScore score = score_by_hand();
  EXPECT_THAT(score_text(score, "test", "m"), Not(HasSubstr("Temperature")));
  score.calibration = {.count = 3, .temperature = 1.5, .log_loss = 0.5, .log_loss_now = 0.75};
  const nlohmann::json figures = score_json(score, 0);
  EXPECT_EQ(figures.at("eval.temperature"), 1.5);
  EXPECT_EQ(figures.at("eval.log_loss"), 0.75);
  EXPECT_EQ(figures.at("eval.log_loss_at_temperature"), 0.5);
  EXPECT_THAT(score_text(score, "test", "m"),
              HasSubstr("\nTemperature: 1.50 (log loss 0.500, as it is 0.750; 3 examples)\n"));
}

TEST(ReplyReport, IsToldWithATable) {
  const std::string text = score_text(score_by_hand(), "calibration", "a model");
  EXPECT_THAT(text, testing::StartsWith("4 examples of the calibration set, a model; of 2 the harm "
                                        "of every policy is known\n\nchoice "));
  EXPECT_THAT(text, HasSubstr("50.0 (25.0 to 75.0)        100.0 0.0625 (0.0000 to 0.1250)"));
  EXPECT_THAT(text, HasSubstr("intervenes in 25.0 (0.0 to 50.0) %."));
  EXPECT_THAT(text, HasSubstr("75.0 % of the replies end by themselves, of 80 tokens (median; at "
                              "most 90)"));
}

}  // namespace
}  // namespace saca::cases::reply_report_test
