#include "saca/lab/model_trials/reason_report.h"

#include <gmock/gmock.h>

#include <chrono>

namespace saca::model_trials::reason_report_test {
namespace {

using language_model::Answer;
using language_model::Explanation;
using manoeuvre::index;
using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Not;

/// Braking first, then steering to the left, by one statement of two that is false.
class ReasonReport : public testing::Test {
 protected:
  ReasonReport() {
    preview_.number = 1;
    preview_.prompt = "# Scene\n";
    preview_.situation.probability = 0.75;
    preview_.situation.scene_at_trigger.time = 2.5;
    reply_.preview = &preview_;
    reply_.reply = {.reasoning = "1. Left is clear.", .prompt_tokens = 400, .reply_tokens = 30};
    reply_.reply.answers = {{.time = std::chrono::milliseconds(50), .kind = Answer::Kind::first},
                            {.time = std::chrono::milliseconds(120), .kind = Answer::Kind::ended}};
    reply_.reply.answers[0].probability.at(index(PolicyId::aeb)) = 1.0;
    reply_.reply.answers[1].probability.at(index(PolicyId::aes_left)) = 0.75;
    reply_.reply.answers[1].probability.at(index(PolicyId::aeb)) = 0.25;
    reply_.truth = {.num_checked = 2, .wrong = {{"Left is clear", "AES-L hits truck1", true}}};
    reply_.check = arbitration::Check{.passed = false, .text = "braking is better"};
    reply_.explanation = Explanation{.text = "1. AEB is clear.\n", .tries = 2};
  }
  arbitration::Preview preview_;
  ForecastReply reply_;
};

// Keys as docs/formats.md has them.
TEST_F(ReasonReport, IsADocument) {
  const nlohmann::json document = reason_json(
      {.scenario = "a", .model = "m", .deadline = 4000, .system = "fixed part"}, {reply_});
  EXPECT_EQ(document.at("schema"), "saca.reason/1");
  EXPECT_EQ(document.at("scenario"), "a");
  EXPECT_EQ(document.at("model"), "m");
  EXPECT_EQ(document.at("deadline_ms"), 4000);
  EXPECT_EQ(document.at("system"), "fixed part");
  const nlohmann::json& forecast = document.at("forecasts").at(0);
  EXPECT_EQ(forecast.at("probability"), 0.75);
  EXPECT_EQ(forecast.at("trigger_s"), 2.5);
  EXPECT_EQ(forecast.at("prompt"), "# Scene\n");
  EXPECT_EQ(forecast.at("answers").at(1).at("policy"), index(PolicyId::aes_left));
  EXPECT_EQ(forecast.at("answers").at(1).at("after_ms"), 120.0);
  EXPECT_EQ(forecast.at("answers").at(0).at("kind"), "first");
  EXPECT_EQ(forecast.at("truth").at("score"), 0.5);
  EXPECT_EQ(forecast.at("explanation").at("from"), "facts");
  EXPECT_EQ(forecast.at("check"),
            (nlohmann::json{{"passed", false}, {"text", "braking is better"}}));
  EXPECT_EQ(reason_json({}, {}).at("forecasts"), nlohmann::json::array());
}

TEST_F(ReasonReport, QuestionsAreToldWithTheirPrompts) {
  EXPECT_EQ(question_text({preview_}),
            "--- Forecast 2 of 1: 75 % likely, trigger at 2.50 s ---\n# Scene\n\n");
  EXPECT_EQ(question_text({}), "");
}

TEST_F(ReasonReport, RepliesAreToldWithTheirAnswersAndReasons) {
  const std::string text = replies_text({reply_}, ReasoningText::told);
  EXPECT_THAT(text,
              testing::StartsWith("--- Forecast 1 ---\n1. Left is clear.\n    after  answer"));
  EXPECT_THAT(text, HasSubstr("\n    50 ms   first   100 %     0 %"));
  EXPECT_THAT(text, HasSubstr("Truth: 1 of 2 statements that can be checked.\n"
                              "  false, and the choice rests on it: \"Left is clear\": AES-L hits "
                              "truck1\n"));
  EXPECT_THAT(text, HasSubstr("Reasons, by the figures, try 2:\n1. AEB is clear.\nChoice: 1 AES-L; "
                              "rollout check failed: braking is better.\n400 tokens read, 30 "
                              "written.\n\n"));
  EXPECT_THAT(replies_text({reply_}, ReasoningText::seen), Not(HasSubstr("1. Left is clear.\n")));
}

TEST_F(ReasonReport, SaysWhereThereIsNothing) {
  EXPECT_EQ(replies_text({}, ReasoningText::told),
            "Nothing threatens in this scenario: there is nothing to ask.\n");
  reply_.reply.answers.clear();
  reply_.check.reset();
  EXPECT_THAT(replies_text({reply_}, ReasoningText::told), HasSubstr("No answer in time.\n\n"));
  EXPECT_TRUE(reason_json({}, {reply_}).at("forecasts").at(0).at("check").is_null());
}

}  // namespace
}  // namespace saca::model_trials::reason_report_test
