#include "saca/thinking/language_model/protocol.h"

#include <gtest/gtest.h>

#include <random>

namespace saca::language_model::protocol::protocol_test {
namespace {

constexpr const char* answer_line = R"({"v":1,"event":"answer","id":3,"scene":1,"kind":"forced",)"
                                    R"("probability":[0.5,0,0,0,0.25,0,0.125,0.125]})";

TEST(Protocol, AskKeepsEverything) {
  const Ask ask{.id = 7,
                .scenes = {"one \"quoted\"\nline", "two"},
                .budget = 4.125,
                .max_tokens = 160,
                .sampling_seed = 2,
                .grammars = {"root ::= \"one\"\n", ""}};
  const auto read = request_from(line(Request(ask)));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto* back = std::get_if<Ask>(&read.value());
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->id, 7);
  EXPECT_EQ(back->scenes, ask.scenes);
  EXPECT_EQ(back->budget, 4.125);
  EXPECT_EQ(back->max_tokens, 160);
  EXPECT_EQ(back->sampling_seed, 2);
  EXPECT_EQ(back->grammars, ask.grammars);
  const auto greedy =
      request_from(R"({"v":1,"cmd":"ask","id":7,"scenes":["one"],"budget_s":1.0,"max_tokens":9})");
  ASSERT_TRUE(greedy.has_value()) << greedy.error().message;
  EXPECT_EQ(std::get<Ask>(greedy.value()).sampling_seed, 0);
  EXPECT_TRUE(std::get<Ask>(greedy.value()).grammars.empty());
  EXPECT_FALSE(request_from(R"({"v":1,"cmd":"ask","id":7,"scenes":["one"],"budget_s":1.0,)"
                            R"("max_tokens":9,"grammars":[1]})")
                   .has_value());
}

TEST(Protocol, CancelNamesItsAsk) {
  const auto read = request_from(line(Request(Cancel{7})));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_TRUE(std::holds_alternative<Cancel>(read.value()));
  EXPECT_EQ(std::get<Cancel>(read.value()).id, 7);
  EXPECT_FALSE(request_from(R"({"v":1,"cmd":"cancel"})").has_value());
}

TEST(Protocol, LinesHoldNoLineEnd) {
  EXPECT_EQ(line(Request(Start{"a\nb"})).find('\n'), std::string::npos);
  EXPECT_EQ(line(Event(Text{1, 0, "a\nb"})).find('\n'), std::string::npos);
}

TEST(Protocol, BrokenUtf8IsReplacedNotThrown) {
  const auto read = event_from(line(Event(Text{1, 0, "a\xff"})));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(std::get<Text>(read.value()).text, "a\xEF\xBF\xBD");  // U+FFFD
}

TEST(Protocol, AnswerIsReadAsWritten) {
  const auto read = event_from(answer_line);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto& answer = std::get<AnswerMessage>(read.value());
  EXPECT_EQ(answer.id, 3);
  EXPECT_EQ(answer.scene, 1U);
  EXPECT_EQ(answer.kind, Answer::Kind::forced);
  EXPECT_EQ(answer.probability[4], 0.25);
  EXPECT_EQ(line(read.value()), line(event_from(line(read.value())).value()));
}

TEST(Protocol, EveryEventComesBackAsItself) {
  const std::vector<Event> events{Ready{"model", 250, 0.5},
                                  PromptRead{1, 2, 330},
                                  Text{1, 0, "text"},
                                  Done{1, {80, 0}, 0.75, 1.5, true},
                                  Info{"model", "file.gguf", 5000000000U, 1U << 30U, 2},
                                  FailureMessage{std::nullopt, "no"},
                                  FailureMessage{4, "no"},
                                  FailureMessage{4, "no time", true}};
  for (const Event& event : events) {
    const auto read = event_from(line(event));
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read.value().index(), event.index());
    EXPECT_EQ(line(read.value()), line(event));
  }
}

TEST(Protocol, RefusalNamesKeyAndWhatCame) {
  const auto refused = [](const std::string& text) {
    const auto read = event_from(text);
    return read.has_value() ? std::string() : read.error().message;
  };
  EXPECT_NE(refused(R"({"v":2,"event":"ready"})").find("v: want 1, got 2"), std::string::npos);
  EXPECT_NE(refused(R"({"event":"ready"})").find("v: want"), std::string::npos);
  EXPECT_NE(refused(R"({"v":1,"event":"song"})").find("song"), std::string::npos);
  EXPECT_NE(refused(R"({"v":1,"event":"text","id":-1,"scene":0,"text":""})").find("id: want"),
            std::string::npos);
  EXPECT_NE(refused(R"({"v":1,"event":"text","id":1,"scene":0.5,"text":""})").find("scene: want"),
            std::string::npos);
  EXPECT_NE(refused("Segmentation fault").find("want JSON, got `Segmentation fault`"),
            std::string::npos);
}

TEST(Protocol, ProbabilitiesMustBeEightThatSumToOne) {
  const auto with = [](const std::string& list) {
    return event_from(R"({"v":1,"event":"answer","id":1,"scene":0,"kind":"first","probability":)" +
                      list + "}")
        .has_value();
  };
  EXPECT_TRUE(with("[1,0,0,0,0,0,0,0]"));
  EXPECT_FALSE(with("[1,0,0,0,0,0,0]"));
  EXPECT_FALSE(with("[1,0,0,0,0,0,0,0,0]"));
  EXPECT_FALSE(with("[0.9,0,0,0,0,0,0,0]"));
  EXPECT_FALSE(with("[2,-1,0,0,0,0,0,0]"));
  EXPECT_FALSE(with("[null,0,0,0,0,0,0,1]"));
  EXPECT_FALSE(with("[1e999,0,0,0,0,0,0,0]"));
}

// Whatever comes is read or refused, never thrown at the caller.
// A line may have 1 MiB; what quotes a value walks it, level by level.
TEST(Protocol, RefusesWhatIsNestedDeeply) {
  for (const std::string& deep :
       {std::string(500'000, '['), std::string(450'000, '[') + std::string(450'000, ']')}) {
    for (const std::string& line :
         {deep, R"({"v":)" + deep + "}", R"({"v":1,"event":)" + deep + "}",
          R"({"v":1,"event":"text","id":1,"scene":0,"text":)" + deep + "}"}) {
      const auto event = event_from(line);
      ASSERT_FALSE(event.has_value());
      EXPECT_LT(event.error().message.size(), 300U);
      EXPECT_FALSE(request_from(line).has_value());
    }
  }
}

TEST(Protocol, DamagedLinesAreReadOrRefused) {
  std::mt19937 random(1);
  const std::string whole = answer_line;
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 4000; ++i) {
    std::string damaged = whole.substr(0, i % 2 == 0 ? whole.size() : place(random));
    for (int k = 0; k < 1 + i % 3 && !damaged.empty(); ++k) {
      damaged[place(random) % damaged.size()] = static_cast<char>(byte(random));
    }
    if (const auto event = event_from(damaged); !event.has_value()) {
      EXPECT_EQ(event.error().code, Error::Code::malformed);
    }
    if (const auto request = request_from(damaged); !request.has_value()) {
      EXPECT_EQ(request.error().code, Error::Code::malformed);
    }
  }
}

}  // namespace
}  // namespace saca::language_model::protocol::protocol_test
