#include "saca/thinking/language_model/shared_model.h"

#include <gmock/gmock.h>

#include <thread>

#include "saca/base/core/parallel.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::language_model::shared_model_test {
namespace {

using namespace std::chrono_literals;
using manoeuvre::PolicyId;

const auto unheard = [](const Progress&) {};

/// Says what is put into it, one answer to one question after the other.
class Queue final : public LanguageModel {
 public:
  explicit Queue(std::vector<Result<std::vector<Reply>>> said) : said_(std::move(said)) {}
  [[nodiscard]] std::string description() const override { return "queue"; }
  [[nodiscard]] std::size_t num_asked() const { return num_asked_; }
  [[nodiscard]] Clock::Time last_deadline() const { return last_deadline_; }

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(const std::vector<std::string>&,
                                                    Clock::Time deadline,
                                                    const std::function<void(const Progress&)>&,
                                                    const AskOptions&) override {
    last_deadline_ = deadline;
    return said_.at(num_asked_++);
  }
  std::vector<Result<std::vector<Reply>>> said_;
  std::size_t num_asked_ = 0;
  Clock::Time last_deadline_{0};
};

std::vector<Reply> reply(Answer::Kind last, Clock::Time at = 1s) {
  std::vector<Answer> answers{{.time = at, .probability = {1.0}, .kind = Answer::Kind::first}};
  if (last != Answer::Kind::first) {
    answers.push_back({.time = at, .probability = {0.5, 0.5}, .kind = last});
  }
  return {{.reasoning = "so", .answers = answers, .prompt_tokens = 3, .reply_tokens = 1}};
}

const Error dead{Error::Code::unreadable, "the model died"};

TEST(SharedModel, DoesNotPutTheSameQuestionTwice) {
  ManualClock clock;
  Queue inner(
      {reply(Answer::Kind::ended), reply(Answer::Kind::forced), reply(Answer::Kind::ended)});
  SharedModel model(inner, clock);
  const auto first = model.ask({"a"}, 9s, unheard).value();
  clock.advance(5s);
  std::vector<Clock::Time> told;
  const auto again = model.ask({"a"}, 14s, [&](const Progress& news) {
    if (news.answer != nullptr) {
      told.push_back(news.answer->time);
    }
  });
  EXPECT_EQ(inner.num_asked(), 1U);
  EXPECT_EQ(again.value()[0].answers[1].probability, first[0].answers[1].probability);
  // The reply took no time of the clock and dates its answers 1 s after the question.
  EXPECT_THAT(told, testing::ElementsAre(6s, 6s));
  EXPECT_TRUE(model.ask({"a"}, 14s, unheard, {.max_tokens = 2}).has_value());
  EXPECT_EQ(inner.num_asked(), 2U);  // that is another one
  EXPECT_TRUE(model.ask({"a"}, 14s, unheard, {.sampling_seed = 1}).has_value());
  EXPECT_EQ(inner.num_asked(), 3U);  // so is that
}

// What a reply may say is part of the question.
TEST(SharedModel, AnotherGrammarIsAnotherQuestion) {
  ManualClock clock;
  ScriptedModel inner(ScriptedReply{.lines = {{.answer = Answer::Kind::ended}}}, clock);
  SharedModel model(inner, clock);
  for (const std::string grammar : {"root ::= \"a\"", "root ::= \"b\"", "root ::= \"a\""}) {
    ASSERT_TRUE(model.ask({"scene"}, 9s, unheard, {.grammars = {grammar}}).has_value());
  }
  EXPECT_EQ(inner.num_asked(), 2);
  EXPECT_EQ(inner.last_grammars(), std::vector<std::string>{"root ::= \"b\""});
}

TEST(SharedModel, AModelThatDiesIsAskedOnceMore) {
  const ManualClock clock;
  Queue inner({dead, reply(Answer::Kind::ended), reply(Answer::Kind::first),
               reply(Answer::Kind::ended), reply(Answer::Kind::first), reply(Answer::Kind::first)});
  SharedModel model(inner, clock);
  EXPECT_EQ(model.ask({"a"}, 9s, unheard).value()[0].answers.size(), 2U);
  EXPECT_EQ(model.ask({"b"}, 9s, unheard).value()[0].answers.size(), 2U);  // it was cut
  EXPECT_EQ(model.ask({"c"}, 9s, unheard).value()[0].answers.size(), 1U);  // it is like that
  EXPECT_EQ(model.failure(), std::nullopt);
}

TEST(SharedModel, OneThatStaysDeadIsAskedNoMore) {
  const ManualClock clock;
  Queue inner({reply(Answer::Kind::ended), dead, dead});
  SharedModel model(inner, clock);
  EXPECT_TRUE(model.ask({"a"}, 9s, unheard).has_value());
  EXPECT_EQ(model.ask({"b"}, 9s, unheard).error(), dead);
  EXPECT_EQ(model.failure(), dead);
  EXPECT_EQ(model.ask({"a"}, 9s, unheard).error(), dead);
  EXPECT_EQ(inner.num_asked(), 3U);
}

// How far it comes by then depends on the machine.
TEST(SharedModel, AReplyThatTheDeadlineCutIsAFailure) {
  ManualClock clock;
  ScriptedModel inner(ScriptedReply{.lines = {{.text = "so", .answer = Answer::Kind::first},
                                              {.after = 20s, .answer = Answer::Kind::ended}}},
                      clock);
  SharedModel model(inner, clock);
  EXPECT_TRUE(model.ask({"a"}, 30s, unheard).has_value());
  const auto cut = model.ask({"b"}, clock.now() + 10s, unheard);
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().code, Error::Code::too_late);
  EXPECT_EQ(model.failure(), cut.error());
}

TEST(SharedModel, AnAnswerThatIsNoneIsSomethingSaid) {
  const ManualClock clock;
  const Error nonsense{Error::Code::malformed, "no answer in it"};
  Queue inner({nonsense, reply(Answer::Kind::ended)});
  SharedModel model(inner, clock);
  EXPECT_EQ(model.ask({"a"}, 9s, unheard).error(), nonsense);
  EXPECT_EQ(model.ask({"a"}, 9s, unheard).error(), nonsense);
  EXPECT_EQ(inner.num_asked(), 1U);
  EXPECT_EQ(model.failure(), std::nullopt);
}

TEST(SharedModel, AStopWithdrawsWithoutAFailure) {
  ManualClock clock;
  ScriptedModel inner(ScriptedReply{.lines = {}}, clock);  // never a word
  std::stop_source all;
  SharedModel model(inner, clock, all.get_token());
  std::stop_source this_one;
  this_one.request_stop();
  EXPECT_EQ(model.ask({"a"}, 9s, unheard, {.stop = this_one.get_token()}).error().code,
            Error::Code::too_late);
  all.request_stop();
  EXPECT_EQ(model.ask({"a"}, 9s, unheard).error().code, Error::Code::too_late);
  EXPECT_EQ(model.failure(), std::nullopt);
  EXPECT_EQ(inner.num_asked(), 0);
}

TEST(SharedModel, PutsScenesOneByOne) {
  ManualClock clock;
  const Error nonsense{Error::Code::malformed, "no answer in it"};
  Queue inner({reply(Answer::Kind::ended), nonsense, reply(Answer::Kind::ended)});
  SharedModel model(inner, clock);
  std::vector<std::size_t> told;
  const auto replies = model.ask({"a", "b"}, 9s, [&](const Progress& news) {
    if (news.answer != nullptr) {
      told.push_back(news.prompt);
    }
  });
  EXPECT_EQ(replies.value()[0].answers.size(), 2U);
  EXPECT_TRUE(replies.value()[1].answers.empty());  // the other's answers count all the same
  EXPECT_THAT(told, testing::ElementsAre(0U, 0U));
  EXPECT_EQ(model.ask({"b", "c", "a"}, 9s, unheard).value()[2].answers.size(), 2U);
  EXPECT_EQ(inner.num_asked(), 3U);
}

/// Counts how many threads ask it at once.
class Counting final : public LanguageModel {
 public:
  [[nodiscard]] std::string description() const override { return "counting"; }
  [[nodiscard]] int most() const { return most_; }

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(const std::vector<std::string>& scenes,
                                                    Clock::Time,
                                                    const std::function<void(const Progress&)>&,
                                                    const AskOptions&) override {
    most_ = std::max(most_.load(), ++now_);
    std::this_thread::yield();
    --now_;
    std::vector<Reply> replies = reply(Answer::Kind::ended);
    replies[0].reasoning = scenes[0];
    return replies;
  }
  std::atomic<int> now_ = 0;
  std::atomic<int> most_ = 0;
};

TEST(SharedModelThreads, AskOneAfterTheOther) {
  const SteadyClock clock;
  Counting inner;
  SharedModel model(inner, clock);
  std::vector<std::string> heard(1'000);  // more than are remembered
  in_parallel(heard.size(), 4, [&](std::size_t i) {
    heard[i] =
        model.ask({std::to_string(i % 400)}, clock.now() + 60s, unheard).value()[0].reasoning;
  });
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i], std::to_string(i % 400));
  }
  EXPECT_EQ(inner.most(), 1);
}

}  // namespace
}  // namespace saca::language_model::shared_model_test
