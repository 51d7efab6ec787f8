#include "saca/lab/model_trials/bench_report.h"

#include <gmock/gmock.h>

#include "saca/thinking/language_model/scripted_model.h"

namespace saca::model_trials::bench_report_test {
namespace {

using testing::HasSubstr;

QuestionTiming timing(double first, double whole, int missing, std::size_t replies) {
  QuestionTiming asked{.first = first, .whole = whole, .missing = missing};
  asked.replies.resize(replies);
  for (language_model::Reply& reply : asked.replies) {
    reply.prompt_tokens = 400;
  }
  return asked;
}

class BenchReport : public testing::Test {
 protected:
  [[nodiscard]] nlohmann::ordered_json figures() {
    return bench_json(bench_figures(bench_, model_, clock_));
  }
  ManualClock clock_;
  language_model::ScriptedModel model_{manoeuvre::PolicyId::aeb, clock_};
  Bench bench_{.one = {timing(0.25, 0.5, 0, 1), timing(0.75, 1.5, 0, 1)},
               .three = {timing(1.0, 2.0, 0, 3), timing(1.0, 5.0, 1, 3)}};
};

// Names as docs/formats.md has them; percentiles by nearest rank.
TEST_F(BenchReport, HasTimesAndMisses) {
  bench_.three[0].forced = 3;
  const nlohmann::ordered_json told = figures();
  EXPECT_EQ(told.at("reason.prompt_tokens"), 400);
  EXPECT_EQ(told.at("reason.first_answer_s.p50"), 0.25);
  EXPECT_EQ(told.at("reason.first_answer_s.max"), 0.75);
  EXPECT_EQ(told.at("reason.full_answer_s.p99"), 1.5);
  EXPECT_EQ(told.at("reason.full_answer_s.n"), 2);
  EXPECT_EQ(told.at("reason.three_previews_s.n"), 1) << "of the one with all its answers";
  EXPECT_EQ(told.at("reason.deadline_misses"), 1);
  EXPECT_EQ(told.at("reason.returned_after_deadline"), 1) << "5 s are more than 4.2 s";
  EXPECT_EQ(told.at("reason.forced_share"), 0.5);
  EXPECT_EQ(told.at("meta.model"), "script");
  EXPECT_FALSE(told.contains("reason.load_s")) << "nobody knows it of another process";
}

TEST_F(BenchReport, OfThreeThatNeverAllAnswerThereAreNoTimes) {
  bench_.three = {timing(0.0, 4.0, 3, 0)};
  const nlohmann::ordered_json told = figures();
  EXPECT_FALSE(told.contains("reason.three_previews_s.p50"));
  EXPECT_EQ(told.at("reason.deadline_misses"), 1);
  EXPECT_EQ(told.at("reason.returned_after_deadline"), 0);
}

TEST_F(BenchReport, IsToldLineByLine) {
  const std::string text =
      bench_text({.numbers = {{"reason.load_s", 1.23456}}, .texts = {{"meta.model", "a model"}}});
  EXPECT_EQ(text,
            "meta.model                           a model\n"
            "reason.load_s                        1.235\n");
}

}  // namespace
}  // namespace saca::model_trials::bench_report_test
