#include "saca/lab/cases/chat_set.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/cases/reply_example.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::cases::chat_set_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json message(const char* role, const char* content) {
  return {{"role", role}, {"content", content}};
}

std::string line(std::initializer_list<json> messages) {
  return json{{"messages", json(messages)}}.dump() + "\n";
}

const std::string chat = line({message("system", "Choose."), message("user", "A truck brakes."),
                               message("assistant", "Response to user: 0")});
constexpr ChatLimits any_number{.least_examples = 0};

std::string why(const std::string& text, const ChatLimits& limits = any_number) {
  const auto checked = check_chat_set(text, "set.jsonl", limits);
  return checked.has_value() ? "" : checked.error().message;
}

TEST(ChatSet, CountsWhatIsRead) {
  const ChatSetFigures figures = check_chat_set(chat + chat, "set.jsonl", any_number).value();
  EXPECT_EQ(figures.examples, 2U);
  const int learnt = language_model::tokens_at_most("Response to user: 0");
  const int all = learnt + language_model::tokens_at_most("Choose.") +
                  language_model::tokens_at_most("A truck brakes.");
  EXPECT_EQ(figures.learnt_tokens, 2 * learnt);
  EXPECT_EQ(figures.tokens, 2 * all);
  EXPECT_EQ(figures.longest, all);
  EXPECT_EQ(why(line({message("user", "a"), message("assistant", "b"), message("user", "c"),
                      message("assistant", "d")})),
            "")
      << "several turns, and no system";
}

TEST(ChatSet, WhatIsExportedKeepsTheRules) {
  ReplyExample example;
  example.prompt = "ego: 14 m/s\n";
  example.reply = "Scenario Analysis\n1. Grip is 0.90.\nResponse to user: 0";
  EXPECT_EQ(why(chat_json(example, "You choose.").dump() + "\n"), "");
}

TEST(ChatSet, WhatBreaksARuleIsToldWithItsLineAndKey) {
  EXPECT_EQ(why(chat + "no json\n"), "set.jsonl: line 2: want an object of JSON");
  EXPECT_THAT(why(chat + "[]\n"), HasSubstr("line 2: want an object"));
  EXPECT_THAT(why(chat + "\n" + chat), HasSubstr("line 2: want an object"));
  EXPECT_THAT(why("{}\n"), HasSubstr("line 1: "));
  EXPECT_THAT(why("{}\n"), HasSubstr("messages"));
  EXPECT_THAT(why(R"({"messages": 7})"), HasSubstr("messages"));
  EXPECT_THAT(why(R"({"messages": [7]})"), HasSubstr("messages[0]"));
  EXPECT_THAT(why(line({message("robot", "x")})), HasSubstr("got \"robot\""));
  EXPECT_THAT(why(line({message("user", " \n"), message("assistant", "b")})), HasSubstr("content"));
  EXPECT_THAT(why(line({message("user", "a"), message("system", "s"), message("assistant", "b")})),
              HasSubstr("first"));
  EXPECT_THAT(why(line({message("user", "a")})), HasSubstr("the assistant's at the end"));
  EXPECT_THAT(why(line({message("assistant", "a")})), HasSubstr("one of the user"));
  json more = message("user", "a");
  more["name"] = "x";
  EXPECT_THAT(why(line({more, message("assistant", "b")})), HasSubstr("name"));
  EXPECT_THAT(why(R"({"messages": [{"role": "user"}]})"), HasSubstr("content"));
  json other = json::parse(chat);
  other["weight"] = 1;
  EXPECT_THAT(why(other.dump()), HasSubstr("weight"));
}

TEST(ChatSet, LimitsAreOfExamplesBytesAndTokens) {
  EXPECT_THAT(why(chat, {}), HasSubstr("want at least 10 examples, got 1"));
  EXPECT_THAT(why("", {}), HasSubstr("got 0"));
  EXPECT_THAT(why(chat, {.least_examples = 0, .most_bytes = 20}),
              HasSubstr("want at most 20 bytes"));
  EXPECT_THAT(why(chat, {.least_examples = 0, .most_tokens = 5}),
              HasSubstr("want at most 5 tokens, got up to"));
}

}  // namespace
}  // namespace saca::cases::chat_set_test
