#include "saca/lab/model_trials/model_score_report.h"

#include <gmock/gmock.h>

namespace saca::model_trials::model_score_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// All ways to choose alike, but that with facts something was said.
eval::ModelScore score_by_hand() {
  eval::ModelScore score;
  for (const eval::ScoredChoice& choice : eval::scored_choices()) {
    eval::MethodFigures figures{.method = std::string(choice.method)};
    figures.harm = {0.25, 0.125, 0.5, 8};
    figures.right = {0.5, 0.25, 0.75, 8};
    figures.regret = {0.0625, 0.0, 0.125, 8};
    figures.contact = {0.375, 0.25, 0.5, 8};
    figures.sources = {{"model", 3}};
    if (choice.key == "facts_reasoned") {
      figures.thinking = {.asked = 8,
                          .answered = 4,
                          .ended = 3,
                          .statements = 10,
                          .false_statements = 1,
                          .unfounded = 1};
    }
    score.choices.push_back(figures);
  }
  return score;
}

// Keys as docs/formats.md has them.
TEST(ModelScoreReport, IsADocument) {
  const nlohmann::json document = model_score_json(score_by_hand(), "saca model score", "m");
  EXPECT_EQ(document.at("schema"), "saca.model_score/2");
  EXPECT_EQ(document.at("command"), "saca model score");
  EXPECT_EQ(document.at("model"), "m");
  EXPECT_EQ(document.at("encounters"), 8);
  EXPECT_EQ(document.at("choices").size(), eval::scored_choices().size());
  const nlohmann::json& choice = document.at("choices").at("facts_at_once");
  EXPECT_EQ(choice.at("harm"),
            (nlohmann::json{{"mean", 0.25}, {"low", 0.125}, {"high", 0.5}, {"n", 8}}));
  EXPECT_EQ(choice.at("sources").at("model"), 3);
  EXPECT_EQ(document.at("with_facts").at("asked"), 8);
  EXPECT_EQ(document.at("with_facts").at("answered_share"), 0.5);
  EXPECT_EQ(document.at("with_facts").at("ended_share"), 0.75);
  EXPECT_EQ(document.at("with_facts").at("statements_true_share"), 0.9);
  EXPECT_EQ(document.at("with_facts").at("unfounded_share"), 0.25);
  EXPECT_TRUE(document.at("without_facts").at("answered_share").is_null()) << "nothing was asked";
  EXPECT_FALSE(document.contains("temperature"));
}

TEST(ModelScoreReport, IsToldWithATable) {
  const std::string text = model_score_text(score_by_hand(), "a model");
  EXPECT_THAT(text, testing::StartsWith("8 encounters, a model; means with 95 % intervals"));
  EXPECT_THAT(text, HasSubstr("50.0 (25.0 to 75.0)  0.0625 (0.0000 to 0.1250)      37.5           "
                              "-         3\n"));
  EXPECT_THAT(text, HasSubstr("\nWith facts: of 8 forecasts asked about 50 % got an answer in "
                              "time, 75 % of these replies end by themselves; of 10 statements "
                              "that can be checked 90 % are true; 25 % of the choices rest on"));
  EXPECT_THAT(text, HasSubstr("\nWithout: of 0 forecasts asked about none got an answer"));
  EXPECT_THAT(text, Not(HasSubstr("Temperature")));
}

TEST(ModelScoreReport, ATemperatureIsToldWhereThereIsOne) {
  eval::ModelScore score = score_by_hand();
  score.calibration = {.count = 6, .temperature = 2.0, .log_loss = 0.5, .log_loss_now = 0.75};
  EXPECT_EQ(
      model_score_json(score, "", "").at("temperature"),
      (nlohmann::json{{"best", 2.0}, {"log_loss", 0.5}, {"log_loss_as_it_is", 0.75}, {"n", 6}}));
  EXPECT_THAT(model_score_text(score, "m"),
              HasSubstr("\nTemperature: 2.00 (log loss 0.500, as it is 0.750; 6 encounters)\n"));
}

}  // namespace
}  // namespace saca::model_trials::model_score_report_test
