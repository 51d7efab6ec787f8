#include "saca/lab/paper_comparison/reply_timing.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::paper_comparison::reply_timing_test {
namespace {

using Kind = language_model::Answer::Kind;

TEST(ReplyTiming, CountsWhatIsDoneByItselfAndInTime) {
  ManualClock clock;
  language_model::ScriptedModel model(
      [](const std::string& scene) {
        const double ends = scene == "slow" ? 6.0 : 2.0;
        if (scene == "silent") {
          return language_model::ScriptedReply{.lines = {{.answer = Kind::first}}};
        }
        return language_model::ScriptedReply{
            .lines = {{.after = from_seconds(0.5), .answer = Kind::first},
                      {.after = from_seconds(ends),
                       .text = "words",
                       .answer = scene == "cut" ? Kind::forced : Kind::ended}},
            .prompt_tokens = 900,
            .reply_tokens = scene == "slow" ? 120 : 60};
      },
      clock);
  const std::vector<FirstQuestion> questions{{{{"fast", "slow"}, {}}, 4.2},
                                             {{{"cut"}, {}}, 4.2},
                                             {{{"fast"}, {}}, 1.9},
                                             {{{"silent"}, {}}, 4.2}};
  const ReplyTimes times = timed_replies(model, clock, questions, 60.0).value();
  EXPECT_EQ(times.asked, 5);
  EXPECT_EQ(times.done, 4);
  EXPECT_EQ(times.ended, 3);
  EXPECT_EQ(times.in_time, 2) << "one is slow, to another only 1.9 s are left";
  EXPECT_DOUBLE_EQ(times.tokens.value, (90.0 + 60.0 + 60.0) / 3.0);
  EXPECT_EQ(times.tokens.n, 3) << "questions";
  EXPECT_NEAR(times.seconds.value, (4.0 + 2.0 + 2.0) / 3.0, 1e-6);
  EXPECT_NEAR(*times.least_seconds, 2.0, 1e-6);
}

TEST(ReplyTiming, WhoNeverAnswersIsAskedAndWhoCannotBeReachedIsAnError) {
  ManualClock clock;
  language_model::ScriptedModel silent(language_model::ScriptedReply{}, clock);
  const std::vector<FirstQuestion> questions{{{{"a"}, {}}, 4.2}, {{{"b"}, {}}, 4.2}};
  const ReplyTimes times = timed_replies(silent, clock, questions, 1.0).value();
  EXPECT_EQ(times.asked, 2);
  EXPECT_EQ(times.ended, 0);
  EXPECT_FALSE(times.least_seconds.has_value());
  language_model::ScriptedModel gone(
      language_model::ScriptedReply{.error = Error{Error::Code::unreadable, "it is gone"}}, clock);
  EXPECT_EQ(timed_replies(gone, clock, questions, 1.0).error().message, "it is gone");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(timed_replies(gone, clock, questions, 1.0, stop.get_token()).value().asked, 0);
  EXPECT_EQ(timed_replies(gone, clock, {}, 1.0).value().seconds.n, 0);
}

TEST(ReplyTiming, TheFirstQuestionIsOfTheForecastsMadeAtFirst) {
  SteadyClock clock;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  const runtime::PlanesSetup setup{.forecast = {&car, &harm}, .clock = &clock};
  const eval::SuiteEncounter dangerous{
      .number = 0, .family = "made", .scenario = eval::standing_car(19.0, 60.0), .twin = {}};
  eval::SuiteEncounter harmless = dangerous;
  harmless.scenario.actors.clear();
  const std::vector<eval::SuiteEncounter> both{dangerous, harmless, dangerous};
  const auto questions =
      first_questions(both, {.methods = {}, .seed = 1}, setup, intent::shipped_model());
  ASSERT_EQ(questions.size(), 2U) << "nothing is asked where nobody is";
  const language_model::Question& first = questions[0].question;
  EXPECT_EQ(first.scenes, questions[1].question.scenes) << "the same draws";
  EXPECT_LE(first.scenes.size(), language_model::most_scenes);
  EXPECT_THAT(first.scenes.front(), testing::HasSubstr("car1"));
  EXPECT_THAT(first.grammars.front(), testing::HasSubstr("car1"));
  // It begins 60 / 19 = 3.16 s before the contact, within T2: no more than 1.86 s are left.
  EXPECT_LT(questions[0].window, 60.0 / 19.0 - 1.3 + 0.1);
  EXPECT_GT(questions[0].window, 1.4);
}

}  // namespace
}  // namespace saca::paper_comparison::reply_timing_test
