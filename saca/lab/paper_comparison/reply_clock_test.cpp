#include "saca/lab/paper_comparison/reply_clock.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::paper_comparison::reply_clock_test {
namespace {

using Kind = language_model::Answer::Kind;
using Model = Result<std::unique_ptr<language_model::LanguageModel>>;

class ReplyClockTest : public testing::Test {
 protected:
  [[nodiscard]] ReplyClock with(std::function<Model(const AskedModel&)> open) const {
    return {.scenarios = "scenarios",
            .car = &car_,
            .setup = &setup_,
            .intent = &intent::shipped_model(),
            .open = std::move(open)};
  }
  /// @param reply  as ScriptedModel takes it
  template <class Reply>
  [[nodiscard]] Model scripted(Reply reply) {
    std::unique_ptr<language_model::LanguageModel> model =
        std::make_unique<language_model::ScriptedModel>(std::move(reply), clock_);
    return model;
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  runtime::PlanesSetup setup_{.forecast = {&car_, &harm_}, .clock = &clock_};
};

TEST(AskedModels, AreThoseThatAreGiven) {
  EXPECT_TRUE(asked_models({}).empty());
  const auto both = asked_models({.memory = "", .model = "local", .untuned = "base"});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].choice, "local");
  EXPECT_STREQ(both[0].key, "model");
  EXPECT_EQ(both[1].choice, "base");
  EXPECT_STREQ(both[1].option, "--untuned");
  EXPECT_STREQ(both[1].key, "untuned");
}

// Table III has one condition: ten draws, in each of which something is asked first.
TEST_F(ReplyClockTest, EachModelIsAskedInTheScenesOfEachTable) {
  const ReplyClock clock = with([&](const AskedModel& asked) -> Model {
    const bool ends = asked.choice == "taught";
    return scripted([ends](const std::string&) {
      return language_model::ScriptedReply{
          .lines = {{.answer = Kind::first},
                    {.text = "words", .answer = ends ? Kind::ended : Kind::forced}},
          .prompt_tokens = 900,
          .reply_tokens = 60};
    });
  });
  const auto timed = timed_models(
      clock, {.thinking = {.memory = "", .model = "taught", .untuned = "base"}, .only = {"3"}});
  ASSERT_TRUE(timed.has_value()) << timed.error().message;
  ASSERT_EQ(timed.value().size(), 2U);
  const TimedModel& taught = timed.value()[0];
  EXPECT_EQ(taught.table, "table_3");
  EXPECT_EQ(taught.title, "the model");
  EXPECT_EQ(taught.key, "model");
  EXPECT_EQ(taught.times.tokens.n, 10);
  EXPECT_GE(taught.times.asked, 10);
  EXPECT_EQ(taught.times.ended, taught.times.asked);
  EXPECT_EQ(timed.value()[1].key, "untuned");
  EXPECT_EQ(timed.value()[1].times.done, taught.times.asked);
  EXPECT_EQ(timed.value()[1].times.ended, 0);
}

TEST_F(ReplyClockTest, AModelThatIsGoneIsNamed) {
  const ReplyClock gone = with([&](const AskedModel&) -> Model {
    return scripted(
        language_model::ScriptedReply{.error = Error{Error::Code::unreadable, "it is gone"}});
  });
  const TableRequest request{.thinking = {.model = "local"}, .only = {"3"}};
  EXPECT_EQ(timed_models(gone, request).error().message, "--llm: it is gone");
  const ReplyClock missing = with([](const AskedModel&) -> Model {
    return Error{Error::Code::unreadable, "no such model"};
  });
  EXPECT_EQ(timed_models(missing, request).error().message, "no such model");
}

// The paper has no replies of the late truck, which is ours.
TEST_F(ReplyClockTest, TablesWithoutPublishedRepliesAskNobody) {
  const ReplyClock clock = with([](const AskedModel&) -> Model {
    ADD_FAILURE() << "nobody is to be asked";
    return Error{Error::Code::unreadable, ""};
  });
  const auto timed = timed_models(clock, {.thinking = {.model = "local"}, .only = {"2_late"}});
  ASSERT_TRUE(timed.has_value());
  EXPECT_TRUE(timed.value().empty());
}

}  // namespace
}  // namespace saca::paper_comparison::reply_clock_test
