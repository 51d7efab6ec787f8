#include "saca/thinking/language_model/replay_model.h"

#include <gmock/gmock.h>

#include <cstdio>

#include "saca/base/core/file.h"
#include "saca/thinking/language_model/news_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::language_model::replay_model_test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// Takes 1 s to the first answer and 3 s to the last: 0 and 1 about "a", 1 and 2 about the others.
ScriptedReply slowly(const std::string& scene) {
  const int policy = scene == "a" ? 0 : 1;
  return {.lines = {{.after = 1s,
                     .text = "about " + scene,
                     .answer = Answer::Kind::first,
                     .policy = manoeuvre::policy_from(policy).value()},
                    {.after = 3s,
                     .answer = Answer::Kind::ended,
                     .policy = manoeuvre::policy_from(policy + 1).value()}},
          .prompt_tokens = 330,
          .reply_tokens = 80};
}

RecordedReplies recorded() {
  ManualClock clock;
  clock.advance(100s);
  ScriptedModel slow(&slowly, clock);
  RecordingModel model(slow, clock);
  EXPECT_TRUE(model.ask({"a", "b"}, 200s, [](const Progress&) {}).has_value());
  return model.recorded();
}

using ReplayTest = NewsTest;

TEST_F(ReplayTest, WhatWasRecordedIsSaidAgainAtItsTimes) {
  ReplayModel model(recorded(), ReplayPace::as_recorded, clock_);
  clock_.advance(10s);
  const auto replies = model.ask({"b"}, 20s, record_);
  ASSERT_TRUE(replies.has_value());
  const Reply& reply = replies.value()[0];
  EXPECT_EQ(reply.reasoning, "about b");
  EXPECT_EQ(reply.prompt_tokens, 330);
  ASSERT_EQ(reply.answers.size(), 2U);
  EXPECT_EQ(reply.answers[0].time, 11s);
  EXPECT_EQ(reply.answers[1].time, 13s);
  EXPECT_EQ(reply.answers[0].probability[1], 1.0);
  EXPECT_THAT(news_, testing::ElementsAre("11 s: 0 answers", "13 s: 0 about b", "13 s: 0 answers"));
}

TEST_F(ReplayTest, AtOnceDoesNotWait) {
  ReplayModel model(recorded(), ReplayPace::at_once, clock_);
  const auto replies = model.ask({"a", "b"}, 20s, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(clock_.now(), 0s);
  EXPECT_EQ(replies.value()[1].answers[1].time, 3s);
}

TEST_F(ReplayTest, AnswersAfterTheDeadlineAreNotThere) {
  ReplayModel model(recorded(), ReplayPace::as_recorded, clock_);
  const auto replies = model.ask({"a"}, 2s, record_);
  ASSERT_TRUE(replies.has_value());
  EXPECT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_EQ(replies.value()[0].reasoning, "");  // it would have come before the second
  EXPECT_EQ(replies.value()[0].reply_tokens, 0);
  EXPECT_LT(clock_.now(), 2s);
  const auto late = model.ask({"a"}, clock_.now() + 500ms, record_);
  ASSERT_FALSE(late.has_value());
  EXPECT_EQ(late.error().code, Error::Code::too_late);
}

TEST_F(ReplayTest, UnknownPromptHasNoAnswer) {
  ReplayModel model(recorded(), ReplayPace::at_once, clock_);
  const auto replies = model.ask({"c"}, 20s, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_THAT(replies.error().message, HasSubstr(prompt_key("c")));
  const auto partly = model.ask({"c", "a"}, 20s, record_);
  ASSERT_TRUE(partly.has_value());
  EXPECT_TRUE(partly.value()[0].answers.empty());
  EXPECT_EQ(partly.value()[1].answers.size(), 2U);
}

TEST_F(ReplayTest, OtherRepliesAreAnotherModel) {
  const auto description = [this](const RecordedReplies& replies) {
    return ReplayModel(replies, ReplayPace::at_once, clock_).description();
  };
  RecordedReplies other = recorded();
  other.replies.begin()->second.reply.reply_tokens += 1;
  EXPECT_THAT(description(recorded()), HasSubstr("replay of script ("));
  EXPECT_EQ(description(recorded()), description(recorded()));
  EXPECT_NE(description(recorded()), description(other));
}

TEST_F(ReplayTest, FileKeepsEverything) {
  ManualClock clock;
  ScriptedModel slow(&slowly, clock);
  RecordingModel model(slow, clock);
  ASSERT_TRUE(model.ask({"a \"b\"\n"}, 200s, record_).has_value());
  const std::string path = testing::TempDir() + "replies.json";
  ASSERT_FALSE(model.write(path).has_value());
  const auto read = parse_replies(read_file(path).value(), path);
  std::remove(path.c_str());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value().model, "script");
  const RecordedReply& reply = read.value().replies.at(prompt_key("a \"b\"\n"));
  EXPECT_EQ(reply.prompt, "a \"b\"\n");
  EXPECT_EQ(reply.reply.answers[1].time, 3s);
  EXPECT_EQ(reply.reply.answers[1].kind, Answer::Kind::ended);
  EXPECT_EQ(json_text(read.value()), json_text(model.recorded()));
}

TEST_F(ReplayTest, RepliesOfDrawnTokensAreKeptApart) {
  ManualClock clock;
  int asked = 0;
  ScriptedModel counting(
      [&](const std::string&) {
        return ScriptedReply{
            .lines = {{.text = std::to_string(++asked), .answer = Answer::Kind::ended}}};
      },
      clock);
  RecordingModel model(counting, clock);
  for (const int seed : {0, 1, 2}) {
    ASSERT_TRUE(model.ask({"a"}, 200s, record_, {.sampling_seed = seed}).has_value());
  }
  const auto read = parse_replies(json_text(model.recorded()), "r.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ReplayModel replay(read.value(), ReplayPace::at_once, clock);
  const auto said = [&](int seed) {
    const auto replies = replay.ask({"a"}, 200s, record_, {.sampling_seed = seed});
    return replies.has_value() ? replies.value()[0].reasoning : replies.error().message;
  };
  EXPECT_EQ(said(0), "1");
  EXPECT_EQ(said(1), "2");
  EXPECT_EQ(said(2), "3");
  EXPECT_THAT(said(3), HasSubstr(prompt_key("a", 3)));
}

// FNV-1a, 64 bits: published values of the empty text and of "a".
TEST(PromptKey, IsFnv1a) {
  EXPECT_EQ(prompt_key(""), "cbf29ce484222325");
  EXPECT_EQ(prompt_key("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(prompt_key("a", 7), prompt_key("a\n7"));
}

TEST(ParseReplies, RefusalNamesFileAndPlace) {
  const auto refused = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    const auto read = parse_replies(text, "r.json");
    return read.has_value() ? std::string() : read.error().message;
  };
  const std::string good = json_text(recorded());
  EXPECT_THAT(refused(good, "saca.replies/1", "saca.replies/2"), HasSubstr("r.json: schema: want"));
  EXPECT_THAT(refused(good, "\"prompt\": \"a\"", "\"prompt\": \"x\""),
              HasSubstr("key of its prompt"));
  const std::string deep = std::string(500'000, '[');
  EXPECT_THAT(refused(good, "\"a\"", deep), HasSubstr("r.json: want JSON of at most 32 levels"));
  EXPECT_LT(refused(good, "saca.replies/1", deep).size(), 300U);
  EXPECT_THAT(refused(good, "1.0", "0.5"), HasSubstr("sum to 1"));
  EXPECT_THAT(refused(good, "1.0", "-1.0"), HasSubstr(">= 0"));
  EXPECT_THAT(refused(good, "\"first\"", "\"song\""), HasSubstr(prompt_key("a")));
  EXPECT_THAT(refused(good, "1000000000", "9000000000"), HasSubstr("order of time"));
  EXPECT_THAT(refused(good, "3000000000", "9223372036854775807"), HasSubstr("within a day"));
  EXPECT_THAT(refused(good, "{", ""), HasSubstr("r.json"));
  EXPECT_THAT(refused(good, "\"replies\"", "\"reply\""), HasSubstr("r.json"));
}

}  // namespace
}  // namespace saca::language_model::replay_model_test
