#include "saca/thinking/language_model/chat_stream.h"

#include <gmock/gmock.h>

#include <random>

namespace saca::language_model::chat_stream_test {
namespace {

using testing::HasSubstr;

std::string event(const std::string& delta, const std::string& reason = "null") {
  return R"(data: {"id":"x","choices":[{"index":0,"delta":)" + delta + R"(,"finish_reason":)" +
         reason + "}]}\n\n";
}

// What a server says that counts tokens; the text is "it is 3 €."
const std::string good = ": hello\n" + event(R"({"role":"assistant","content":null})") +
                         event(R"({"content":"it is "})") +
                         event("{\"content\":\"3 \xE2\x82\xAC.\"}") + event("{}", "\"stop\"") +
                         "data: {\"choices\":[],\"usage\":{\"prompt_tokens\":330,"
                         "\"completion_tokens\":7,\"more\":1}}\n\ndata: [DONE]\n\n";

std::string problem(const std::string& bytes) {
  ChatStream stream;
  const auto said = stream.take(bytes);
  return said.has_value() ? "none" : said.error().message;
}

TEST(ChatStream, IsTheSameWhereverItIsCut) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{7}, good.size()}) {
    ChatStream stream;
    std::string text;
    for (std::size_t i = 0; i < good.size(); i += size) {
      const auto said = stream.take(std::string_view(good).substr(i, size));
      ASSERT_TRUE(said.has_value()) << said.error().message;
      text += said.value();
    }
    EXPECT_EQ(text, "it is 3 \xE2\x82\xAC.");
    EXPECT_EQ(stream.text(), text);
    EXPECT_TRUE(stream.finished());
    EXPECT_TRUE(stream.done());
    EXPECT_FALSE(stream.cut());
    EXPECT_EQ(stream.prompt_tokens(), 330);
    EXPECT_EQ(stream.reply_tokens(), 7);
  }
}

TEST(ChatStream, LinesMayEndInCarriageReturnAndLineFeed) {
  ChatStream stream;
  EXPECT_EQ(stream.take("event: x\r\ndata:{\"choices\":[{\"delta\":{\"content\":\"a\"}}]}\r\n\r\n")
                .value(),
            "a");
  EXPECT_FALSE(stream.finished());
  EXPECT_EQ(stream.take("data: [DONE]\r\n\r\n").value(), "");
  EXPECT_TRUE(stream.done());
}

TEST(ChatStream, TextCutByMaxTokensSaysSo) {
  ChatStream stream;
  ASSERT_TRUE(stream.take(event(R"({"content":"it"})", "\"length\"")).has_value());
  EXPECT_TRUE(stream.finished());
  EXPECT_TRUE(stream.cut());
  EXPECT_FALSE(stream.done());
}

TEST(ChatStream, WrongEventsAreNamed) {
  EXPECT_THAT(problem("data: {\"choices\":\n"), HasSubstr("want a JSON object in each event"));
  EXPECT_THAT(problem("data: 7\n"), HasSubstr("got 7"));
  EXPECT_THAT(problem("data: {}\n"), HasSubstr("choices: want a list"));
  EXPECT_THAT(problem("data: {\"choices\":{}}\n"), HasSubstr("choices: want a list"));
  EXPECT_THAT(problem("data: {\"choices\":[7]}\n"), HasSubstr("want an object"));
  EXPECT_THAT(problem("data: {\"choices\":[null]}\n"), HasSubstr("want an object"));
  EXPECT_THAT(problem(event("[]")), HasSubstr("want an object"));
  EXPECT_THAT(problem(event("{\"content\":7}")), HasSubstr("want texts"));
  EXPECT_THAT(problem(event("{}", "1")), HasSubstr("want texts"));
  EXPECT_THAT(problem("data: {\"choices\":[],\"usage\":{\"prompt_tokens\":-1}}\n"),
              HasSubstr("want counts"));
  EXPECT_THAT(problem("data: {\"choices\":[],\"usage\":{\"completion_tokens\":1e300}}\n"),
              HasSubstr("want counts"));
  EXPECT_THAT(problem("data: {\"choices\":[],\"usage\":[]}\n"), HasSubstr("want counts"));
  EXPECT_THAT(problem("data: {\"choices\":[],\"usage\":{\"prompt_tokens\":4294967296}}\n"),
              HasSubstr("want counts"));
  EXPECT_THAT(problem("data: {\"error\":{\"message\":\"out of memory\"}}\n"),
              HasSubstr("want text, got out of memory"));
  EXPECT_THAT(problem(event("{\"content\":\"\xFF\"}")), HasSubstr("want a JSON object"));
  EXPECT_THAT(problem("data: " + std::string(200'000, '[') + "\n"),
              HasSubstr("want a JSON object"));
}

TEST(ChatStream, HasBounds) {
  EXPECT_EQ(problem(":" + std::string((1U << 18U) - 1, 'x')), "none");
  EXPECT_THAT(problem(":" + std::string(1U << 18U, 'x')), HasSubstr("256 KiB"));
  EXPECT_EQ(problem(event("{\"content\":\"" + std::string(1U << 16U, 'x') + "\"}")), "none");
  EXPECT_THAT(problem(event("{\"content\":\"" + std::string((1U << 16U) + 1, 'x') + "\"}")),
              HasSubstr("64 KiB"));
}

TEST(ChatStream, KeepsTheBeginningOfWhatIsNoStream) {
  ChatStream stream;
  EXPECT_EQ(stream.take("<html>\nno").value(), "");
  EXPECT_EQ(stream.head(), "<html>\nno");
  EXPECT_FALSE(stream.finished());
  ASSERT_TRUE(stream.take(std::string(100'000, '\n')).has_value());
  EXPECT_EQ(stream.head().size(), 4096U);
}

TEST(ChatStream, RefusesWhatIsNestedDeeply) {
  std::string errors;
  for (int i = 0; i < 20'000; ++i) {
    errors += R"({"error":)";
  }
  ChatStream stream;
  const auto taken = stream.take("data: " + errors + "1" + std::string(20'000, '}') + "\n");
  ASSERT_FALSE(taken.has_value());
  EXPECT_NE(taken.error().message.find("want a JSON object"), std::string::npos);
  EXPECT_EQ(server_message(std::string(60'000, '[')), std::string(60'000, '['));
}

TEST(ChatStream, DamageNeverThrows) {
  std::mt19937 random(7);  // NOLINT: the same damage each time
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    }
    ChatStream stream;
    EXPECT_NO_THROW((void)stream.take(bytes));
    EXPECT_LE(stream.text().size(), bytes.size());
  }
}

TEST(ChatQuestion, IsWhatServersRead) {
  const std::string text =
      json_text({.model = "m", .system = "rules \"1\"", .scene = "a\xFF", .max_tokens = 160});
  EXPECT_EQ(text, R"({"model":"m","messages":[{"role":"system","content":"rules \"1\""},)"
                  "{\"role\":\"user\",\"content\":\"a\xEF\xBF\xBD\"}],"
                  R"("max_tokens":160,"stream":true,"stream_options":{"include_usage":true},)"
                  R"("temperature":0})");
  EXPECT_THAT(json_text({.model = "m", .max_tokens = 7, .sampling_seed = 3}),
              testing::HasSubstr(R"("seed":3,"temperature":0.7})"));
  EXPECT_EQ(json_text({.model = "m", .system = "", .scene = "", .max_tokens = 7, .newer = true}),
            R"({"model":"m","messages":[{"role":"system","content":""},)"
            R"({"role":"user","content":""}],"max_completion_tokens":7,"stream":true,)"
            R"("stream_options":{"include_usage":true}})");
}

TEST(ServerMessage, IsFoundWhereServersPutIt) {
  EXPECT_EQ(server_message(R"({"error":{"message":"no such model","code":404}})"), "no such model");
  EXPECT_EQ(server_message(R"({"error":"busy"})"), "busy");
  EXPECT_EQ(server_message(R"({"object":"error","message":"too long"})"), "too long");
  EXPECT_EQ(server_message(R"({"detail":"Not Found"})"), "Not Found");
  EXPECT_EQ(server_message(R"({"error":7})"), R"({"error":7})");
  EXPECT_EQ(server_message("<html>"), "<html>");
  EXPECT_EQ(server_message(""), "");
}

}  // namespace
}  // namespace saca::language_model::chat_stream_test
