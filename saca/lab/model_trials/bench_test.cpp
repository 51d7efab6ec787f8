#include "saca/lab/model_trials/bench.h"

#include <gtest/gtest.h>

#include "saca/thinking/language_model/scripted_model.h"

namespace saca::model_trials::bench_test {
namespace {

using language_model::ScriptedModel;
using language_model::ScriptedReply;

TEST(BenchTest, AsksAsOftenAboutOneAsAboutThree) {
  ManualClock clock;
  ScriptedModel model(manoeuvre::PolicyId::aeb, clock);
  const Bench bench = bench_of(model, 2, clock).value();
  EXPECT_EQ(model.num_asked(), 4);
  ASSERT_EQ(bench.one.size(), 2U);
  ASSERT_EQ(bench.three.size(), 2U);
  EXPECT_EQ(bench.one[1].replies.size(), 1U);
  EXPECT_EQ(bench.three[1].replies.size(), 3U);
  EXPECT_EQ(bench.load, 0.0) << "it is no child process";
}

TEST(BenchTest, ThereIsNoneOfAModelThatDoesNotAnswer) {
  ManualClock clock;
  ScriptedModel model(ScriptedReply{.error = Error{Error::Code::unreadable, "gone"}}, clock);
  EXPECT_EQ(bench_of(model, 2, clock).error().message, "gone");
  EXPECT_EQ(model.num_asked(), 1);
}

// Three at once may fail: that is a figure, too.
TEST(BenchTest, ThreeMayBeTooMany) {
  ManualClock clock;
  int asked = 0;
  ScriptedModel model(
      [&asked](const std::string&) {
        return ++asked > 1
                   ? ScriptedReply{.error = Error{Error::Code::too_late, "too slow"}}
                   : ScriptedReply{.lines = {{.answer = language_model::Answer::Kind::first}}};
      },
      clock);
  const Bench bench = bench_of(model, 1, clock).value();
  EXPECT_EQ(bench.three.at(0).missing, 3);
}

}  // namespace
}  // namespace saca::model_trials::bench_test
