#include "saca/thinking/language_model/openai_model.h"

#include <gmock/gmock.h>
#include <netdb.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/thinking/language_model/child_process.h"
#include "saca/thinking/language_model/rude_server_for_test.h"
#include "saca/thinking/language_model/stepping_clock_for_test.h"

namespace saca::language_model::openai_model_test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr auto deadline = 4s;
constexpr auto long_time = 1000s;    // real seconds of steps, for what must succeed
constexpr Clock::Time step = 150ms;  // fewer than six of them fill the time kept for the way back

// The names that test programs look up go through this function; those of hosts that hang stay here
// until they are let go.
std::atomic<bool> look_up_hangs{false};
std::atomic<int> num_looking_up{0};

class OpenAiModelTest : public testing::Test {
 protected:
  OpenAiModelSettings settings(const std::string& url, const std::string& key = {}) {
    return {.url = url, .model = "small", .key = key, .system = "rules", .margin = 1.0};
  }
  // One scene; what it failed with.
  std::string failure(OpenAiModel& model, Error::Code code = Error::Code::unreadable) {
    const auto replies = model.ask({"a"}, clock_.now() + deadline, record_);
    if (replies.has_value()) {
      return "it answered";
    }
    EXPECT_EQ(replies.error().code, code);
    EXPECT_EQ(replies.error().message.find('\n'), std::string::npos);
    return replies.error().message;
  }
  std::string failure(const RudeServer::Behaviour& behaviour,
                      Error::Code code = Error::Code::unreadable) {
    RudeServer server({behaviour});
    OpenAiModel model(settings(server.url()), clock_);
    std::string message = failure(model, code);
    EXPECT_THAT(message, HasSubstr(server.url() + "/chat/completions: "));
    EXPECT_EQ(server.num_requests(), 1U);
    return message;
  }

  SteppingClock clock_;
  std::string text_;
  std::function<void(const Progress&)> record_ = [this](const Progress& p) { text_ += p.text; };
};

TEST_F(OpenAiModelTest, TheTextsLastResponseIsTheAnswer) {
  RudeServer server({sends(good_reply(3))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  const Reply& reply = replies.value()[0];
  EXPECT_EQ(reply.reasoning, "it is \xE2\x82\xAC, so\nResponse to user: 3");
  EXPECT_EQ(text_, reply.reasoning);
  EXPECT_EQ(reply.prompt_tokens, 330);
  EXPECT_EQ(reply.reply_tokens, 7);
  ASSERT_EQ(reply.answers.size(), 1U);
  EXPECT_EQ(reply.answers[0].kind, Answer::Kind::ended);
  EXPECT_THAT(reply.answers[0].probability, testing::ElementsAre(0, 0, 0, 1, 0, 0, 0, 0));
  EXPECT_EQ(model.description(), "small at " + server.url());
}

TEST_F(OpenAiModelTest, TheRequestIsWhatServersRead) {
  RudeServer server({sends(good_reply(3))});
  OpenAiModel model(settings(server.url() + "/", "sk-0123456789"), clock_);
  ASSERT_TRUE(model.ask({"the scene"}, deadline, record_).has_value());
  EXPECT_THAT(server.requests()[0],
              AllOf(testing::StartsWith("POST /v1/chat/completions HTTP/1.1\r\n"),
                    HasSubstr("\r\nAuthorization: Bearer sk-0123456789\r\n"),
                    HasSubstr("\r\nContent-Type: application/json\r\n"),
                    HasSubstr(R"({"role":"user","content":"the scene"})"),
                    HasSubstr(R"("max_tokens":160,"stream":true)")));
  OpenAiModel without(settings(server.url()), clock_);
  ASSERT_TRUE(without.ask({"a"}, deadline, record_).has_value());
  EXPECT_THAT(server.requests()[1], Not(HasSubstr("Authorization")));
}

TEST_F(OpenAiModelTest, PiecesOfAnySizeAreOneText) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{3}, std::size_t{50}}) {
    RudeServer server({[&](Visit& visit) { visit.send_in_pieces(good_reply(6), size); }});
    OpenAiModel model(settings(server.url()), clock_);
    text_.clear();
    int num_broken = 0;
    const auto replies = model.ask({"a"}, deadline, [&](const Progress& p) {
      text_ += p.text;
      num_broken += p.text.ends_with('\xE2') || p.text.ends_with('\x82') ? 1 : 0;
    });
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    EXPECT_EQ(text_, "it is \xE2\x82\xAC, so\nResponse to user: 6");
    EXPECT_EQ(num_broken, 0);
  }
}

TEST_F(OpenAiModelTest, ThreeScenesAreAskedAtOnce) {
  // None is answered before all have asked.
  std::atomic<int> num_waiting{0};
  RudeServer server({[&](Visit& visit) {
    ++num_waiting;
    while (num_waiting < 3) {
      std::this_thread::yield();
    }
    const std::size_t at = visit.request().find("scene ");
    (void)visit.send(good_reply(visit.request().at(at + 6) - '0'));
  }});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"scene 4", "scene 2", "scene 7"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value()[0].answers.at(0).probability[4], 1.0);
  EXPECT_EQ(replies.value()[1].answers.at(0).probability[2], 1.0);
  EXPECT_EQ(replies.value()[2].answers.at(0).probability[7], 1.0);
}

TEST_F(OpenAiModelTest, OneSceneMayFailAlone) {
  RudeServer server({[&](Visit& visit) {
    (void)visit.send(visit.request().find("bad") == std::string::npos ? good_reply(1)
                                                                      : http(400, "too long"));
  }});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"bad", "good"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_TRUE(replies.value()[0].answers.empty());
  EXPECT_EQ(replies.value()[1].answers.size(), 1U);
}

TEST_F(OpenAiModelTest, ConnectionIsUsedAgain) {
  const std::string reply = good_reply(1).substr(stream_head.size());
  RudeServer server({[&](Visit& visit) {
    const std::string head = "HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(reply.size());
    (void)visit.send(head + "\r\n\r\n" + reply);
    visit.wait(-1);  // it ends with the model
  }});
  std::optional<OpenAiModel> model(std::in_place, settings(server.url()), clock_);
  ASSERT_TRUE(model->ask({"a"}, deadline, record_).has_value());
  // The server answers once per connection: a second request on it stays without an answer.
  clock_.step(step);
  EXPECT_FALSE(model->ask({"a"}, clock_.now() + deadline, record_).has_value());
  EXPECT_EQ(server.num_requests(), 1U);
}

TEST_F(OpenAiModelTest, StreamThatStaysOpenAfterItsEndIsNotWaitedFor) {
  RudeServer server({falls_silent_after(good_reply(2))});
  OpenAiModel model(settings(server.url()), clock_);  // time stands still: only the end can end it
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
}

// What the deadline or max_tokens cuts.

TEST_F(OpenAiModelTest, DeadlineForcesTheLastResponseSoFar) {
  RudeServer server({falls_silent_after(stream_head + said("Response to user: 5, no: ") +
                                        said("Response to user: "))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, deadline, [&](const Progress&) { clock_.step(step); });
  EXPECT_LT(clock_.last_look(), deadline);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  ASSERT_EQ(replies.value()[0].answers.size(), 1U);
  EXPECT_EQ(replies.value()[0].answers[0].kind, Answer::Kind::forced);
  EXPECT_EQ(replies.value()[0].answers[0].probability[5], 1.0);
}

TEST_F(OpenAiModelTest, TextWithoutResponseIsLateAtTheDeadline) {
  RudeServer server({falls_silent_after(stream_head + said("hm"))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, deadline, [&](const Progress&) { clock_.step(step); });
  EXPECT_LT(clock_.last_look(), deadline);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::too_late);
  EXPECT_THAT(replies.error().message, HasSubstr("got 2 bytes of text"));
}

TEST_F(OpenAiModelTest, MaxTokensForceTheAnswer) {
  RudeServer server(
      {sends(stream_head + "data: {\"choices\":[{\"delta\":{\"content\":\"Response to "
                           "user: 1\"},\"finish_reason\":\"length\"}]}\n\n")});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value()[0].answers[0].kind, Answer::Kind::forced);
}

TEST_F(OpenAiModelTest, SilenceIsLate) {
  clock_.step(step);
  const std::vector<RudeServer::Behaviour> silences{
      falls_silent_after(""), falls_silent_after("HTTP/1.1 200"), falls_silent_after(stream_head),
      falls_silent_after(stream_head + "data: {\"cho")};
  for (const RudeServer::Behaviour& silence : silences) {
    const Clock::Time begin = clock_.now();
    EXPECT_THAT(failure(silence, Error::Code::too_late), HasSubstr("want an answer before"));
    EXPECT_LT(clock_.last_look(), begin + deadline);
  }
}

TEST_F(OpenAiModelTest, RefusalWithoutItsEndIsARefusal) {
  RudeServer server({[&](Visit& visit) {
    const std::string all = http(401, "who are you?");
    (void)visit.send(all.substr(0, all.size() - 1));
    visit.wait(20);
    clock_.step(step);
    visit.wait(-1);
  }});
  OpenAiModel model(settings(server.url()), clock_);
  EXPECT_THAT(failure(model), HasSubstr("want HTTP 200, got 401: who are you"));
  EXPECT_LT(clock_.last_look(), deadline);
}

TEST_F(OpenAiModelTest, EndlessCommentsAreLate) {
  clock_.step(10ms);
  const auto talk = [](Visit& visit) {
    for ((void)visit.send(stream_head); visit.send(": keep waiting\n");) {
    }
  };
  const Clock::Time begin = clock_.now();
  EXPECT_THAT(failure(talk, Error::Code::too_late), HasSubstr("got 0 bytes"));
  EXPECT_LT(clock_.last_look(), begin + deadline);
}

// On the machine's clock: a word each 50 ms for a second, and silence. How late it returns is the
// machine's affair, but for `make soak`, which runs on one that has nothing else to do.
TEST_F(OpenAiModelTest, ReturnsInRealTime) {
  const bool soaking = std::getenv("SACA_SOAK_CLOCK") != nullptr;
  const Clock::Time tolerance = soaking ? Clock::Time(500ms) : Clock::Time(1000s);
  const std::vector<RudeServer::Behaviour> behaviours{
      falls_silent_after(""), falls_silent_after(stream_head), [](Visit& visit) {
        (void)visit.send(stream_head);
        for (int word = 0; word < 20 && visit.send(said("word ")) && !visit.wait(50); ++word) {
        }
      }};
  for (const RudeServer::Behaviour& behaviour : behaviours) {
    RudeServer server({behaviour});
    SteadyClock clock;
    OpenAiModel model({.url = server.url(), .model = "small"}, clock);  // its usual margin
    const Clock::Time end = clock.now() + 200ms;
    const auto replies = model.ask({"a", "b", "c"}, end, record_);
    EXPECT_LT(clock.now(), end + tolerance);
    ASSERT_FALSE(replies.has_value());
    EXPECT_EQ(replies.error().code, Error::Code::too_late);
  }
  if (soaking) {  // a slow machine may not hear the first one in time
    EXPECT_THAT(text_, HasSubstr("word "));
  }
}

TEST_F(OpenAiModelTest, LookUpOfTheHostIsNotWaitedFor) {
  clock_.step(step);
  look_up_hangs = true;
  {
    OpenAiModel model(settings("https://hanging.test/v1"), clock_);
    EXPECT_THAT(failure(model, Error::Code::too_late), HasSubstr("https://hanging.test/v1"));
    EXPECT_LT(clock_.last_look(), deadline);
  }
  while (num_looking_up == 0) {  // its thread may begin only now: nobody has waited for it
    std::this_thread::yield();
  }
  look_up_hangs = false;
  while (num_looking_up > 0) {
    std::this_thread::yield();
  }
}

// What is asked again.

TEST_F(OpenAiModelTest, BusyServersAreAskedAgain) {
  clock_.step(20ms);
  const RudeServer::Behaviour gone = [](Visit&) {};
  const RudeServer::Behaviour reset = [](Visit& visit) { visit.reset(); };
  const RudeServer::Behaviour short_body = sends("HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\n:");
  for (const auto& busy :
       {sends(http(429, "slow down")), sends(http(500, "")), sends(http(502, "")),
        sends(http(503, "loading")), sends(http(504, "")), gone, reset, short_body}) {
    RudeServer server({busy, sends(good_reply(4))});
    OpenAiModel model(settings(server.url()), clock_);
    const auto replies = model.ask({"a"}, clock_.now() + long_time, record_);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    EXPECT_EQ(server.num_requests(), 2U);
  }
}

TEST_F(OpenAiModelTest, PausesDouble) {
  clock_.step(20ms);
  std::vector<Clock::Time> times;
  const RudeServer::Behaviour busy = [&](Visit& visit) {
    times.push_back(clock_.last_look());
    (void)visit.send(http(429, "slow down"));
  };
  RudeServer server({busy, busy, busy, busy, sends(good_reply(4))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, long_time, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  times.push_back(replies.value()[0].answers.at(0).time);
  ASSERT_EQ(times.size(), 5U);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    EXPECT_GE(times[i + 1] - times[i], 50ms * (1 << i));
  }
}

TEST_F(OpenAiModelTest, RetryAfterIsHonoured) {
  clock_.step(100ms);
  RudeServer server({sends(http(429, "", "Retry-After: 2\r\n")), sends(good_reply(4))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, long_time, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(server.num_requests(), 2U);
  EXPECT_GE(replies.value()[0].answers.at(0).time, 2s);
}

// In the next three time stands still: they do not wait.

TEST_F(OpenAiModelTest, RetryAfterTheDeadlineGivesUpAtOnce) {
  for (const char* wait : {"4", "99999999999999999"}) {
    EXPECT_THAT(failure(sends(http(503, "{\"error\":\"full\"}",
                                   "Retry-After: " + std::string(wait) + "\r\n"))),
                HasSubstr("want HTTP 200, got 503: full (no time is left to ask again)"));
  }
}

TEST_F(OpenAiModelTest, BusyServerJustBeforeTheDeadlineIsToldOf) {
  RudeServer server({sends(http(429, R"({"error":{"message":"slow down"}})"))});
  OpenAiModel model(settings(server.url()), clock_);
  const auto replies = model.ask({"a"}, 1s + 50ms, record_);  // all that is left is one pause
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::unreadable);
  EXPECT_THAT(replies.error().message, HasSubstr("got 429: slow down (no time"));
  EXPECT_EQ(server.num_requests(), 1U);
}

TEST_F(OpenAiModelTest, RefusedConnectionIsToldOf) {
  std::string url;
  {
    const RudeServer server({sends("")});
    url = server.url();
  }
  OpenAiModel model(settings(url), clock_);
  const auto replies = model.ask({"a"}, 1s + 50ms, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::unreadable);
  EXPECT_THAT(replies.error().message, AllOf(HasSubstr(url), HasSubstr("onnect")));
}

TEST_F(OpenAiModelTest, AServerThatIsNotThereIsNotWaitedForUntilTheDeadline) {
  clock_.step(50ms);
  std::string url;
  {
    const RudeServer server({sends("")});
    url = server.url();
  }
  OpenAiModel model(settings(url), clock_);
  const auto replies = model.ask({"a", "b"}, long_time, record_);
  ASSERT_FALSE(replies.has_value());
  EXPECT_EQ(replies.error().code, Error::Code::unreadable);
  EXPECT_THAT(replies.error().message,
              AllOf(HasSubstr(url), HasSubstr("onnect"), HasSubstr("(7 times)")));
  EXPECT_GT(clock_.last_look(), 3s);  // it may only be starting
  EXPECT_LT(clock_.last_look(), long_time / 10);
}

TEST_F(OpenAiModelTest, SilenceAfterASetbackTellsOfIt) {
  clock_.step(10ms);
  RudeServer server({sends(http(503, "loading")), [&](Visit& visit) {
                       clock_.step(step);
                       visit.wait(-1);
                     }});
  OpenAiModel model(settings(server.url()), clock_);
  EXPECT_THAT(failure(model, Error::Code::too_late),
              HasSubstr("got 0 bytes of text; before that: want HTTP 200, got 503: loading"));
}

// What is not.

TEST_F(OpenAiModelTest, RefusalsAreNotRepeated) {
  for (const int status : {400, 401, 403, 404, 418, 301, 201}) {
    const std::string message =
        failure(sends(http(status, R"({"error":{"message":"no\nsuch model"}})")));
    EXPECT_THAT(message,
                HasSubstr("want HTTP 200, got " + std::to_string(status) + ": no such model"));
    const bool lacks_key = status == 401 || status == 403;
    EXPECT_EQ(message.find("no key was given") != std::string::npos, lacks_key) << message;
  }
}

TEST_F(OpenAiModelTest, NewerModelsAreAskedInTheirWay) {
  RudeServer server({[&](Visit& visit) {
    const bool newer = visit.request().find("max_completion_tokens") != std::string::npos;
    (void)visit.send(
        newer ? good_reply(2)
              : http(400, R"({"error":{"message":"Unsupported parameter: 'max_tokens' is not )"
                          R"(supported with this model. Use 'max_completion_tokens' instead."}})"));
  }});
  OpenAiModel model(settings(server.url()), clock_);
  for (int i = 0; i < 2; ++i) {
    const auto replies = model.ask({"a"}, deadline, record_);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    EXPECT_EQ(replies.value()[0].answers.at(0).probability[2], 1.0);
  }
  ASSERT_EQ(server.requests().size(), 3U);  // it is remembered
  EXPECT_THAT(server.requests()[1],
              AllOf(Not(HasSubstr("\"max_tokens\"")), Not(HasSubstr("temperature"))));
}

TEST_F(OpenAiModelTest, ServerThatRefusesBothFormsIsAskedTwice) {
  RudeServer server({sends(http(400, "use max_completion_tokens"))});
  OpenAiModel model(settings(server.url()), clock_);
  EXPECT_FALSE(model.ask({"a"}, deadline, record_).has_value());
  EXPECT_EQ(server.requests().size(), 2U);
}

TEST_F(OpenAiModelTest, RedirectIsNotFollowed) {
  RudeServer other({sends(good_reply(1))});
  EXPECT_THAT(failure(sends(http(307, "", "Location: " + other.url() + "/chat/completions\r\n"))),
              HasSubstr("got 307"));
  EXPECT_EQ(other.num_requests(), 0U);
}

TEST_F(OpenAiModelTest, TextThatBreaksOffIsNotAskedForAgain) {
  const std::string half = stream_head + said("Response to user: 1");
  EXPECT_THAT(failure(sends(half)), HasSubstr("want a stream of text and its end, got Response"));
  EXPECT_THAT(failure([&](Visit& visit) {
                (void)visit.send(half);
                visit.wait(20);  // else the reset overtakes the text
                visit.reset();
              }),
              HasSubstr("want a stream of text"));
}

TEST_F(OpenAiModelTest, WhatIsNoStreamIsQuoted) {
  EXPECT_THAT(failure(sends(http(200, "<html>\x1B[1mhello</html>"))),
              HasSubstr("got <html> [1mhello</html>"));
  EXPECT_THAT(failure(sends(http(200, R"({"error":"use /api"})"))), HasSubstr("got use /api"));
  EXPECT_THAT(failure(sends(stream_head + "data: {\"choices\n\n")),
              HasSubstr("want a JSON object in each event, got {\"choices"));
  EXPECT_THAT(failure(sends("SSH-2.0-OpenSSH_9.2\r\n")), HasSubstr("want a stream of text"));
}

TEST_F(OpenAiModelTest, TextWithoutResponseIsQuoted) {
  EXPECT_THAT(
      failure(sends(stream_head + said("I cannot say.") + stream_end), Error::Code::malformed),
      HasSubstr("want `Response to user: N` at the end of the text, got I cannot say."));
}

TEST_F(OpenAiModelTest, TooMuchIsCutOff) {
  const std::string million(1'000'000, 'x');
  EXPECT_THAT(failure(sends(stream_head + said("Response to user: 1") + said(million))),
              HasSubstr("want"));
  std::string talk = stream_head;
  for (int i = 0; i < 100; ++i) {
    talk += said(million.substr(0, 1000));
  }
  EXPECT_THAT(failure(sends(talk)), HasSubstr("64 KiB"));
  EXPECT_THAT(failure(sends(stream_head + million)), HasSubstr("256 KiB"));
  EXPECT_THAT(failure(sends(http(503, million))), AllOf(HasSubstr("503"), HasSubstr("64 KiB")));
  EXPECT_THAT(failure(sends("HTTP/1.1 200 OK\r\nX: " + million)), HasSubstr("want a stream"));
}

// The key and the address.

TEST_F(OpenAiModelTest, KeyIsNeverShown) {
  const std::string key = "sk-0123456789abcdef";
  const RudeServer::Behaviour echo = [](Visit& visit) {
    (void)visit.send(http(401, visit.request()));
  };
  const RudeServer::Behaviour cut = [&](Visit& visit) {
    (void)visit.send(
        http(401, std::string(185, '.') + visit.request().substr(visit.request().find(key))));
  };
  const RudeServer::Behaviour stream = [&](Visit& visit) {
    (void)visit.send(stream_head + "data: {\"error\":{\"message\":\"" + key + "\"}}\n\n");
  };
  const RudeServer::Behaviour text = [&](Visit& visit) {
    (void)visit.send(stream_head + said(key) + stream_end);
  };
  const std::vector<std::pair<RudeServer::Behaviour, Error::Code>> all{
      {echo, Error::Code::unreadable},
      {cut, Error::Code::unreadable},
      {stream, Error::Code::unreadable},
      {text, Error::Code::malformed}};
  for (const auto& [behaviour, code] : all) {
    RudeServer server({behaviour});
    OpenAiModel model(settings(server.url(), key), clock_);
    EXPECT_THAT(failure(model, code), AllOf(HasSubstr("***"), Not(HasSubstr("sk-0123"))));
    EXPECT_THAT(model.description(), Not(HasSubstr(key)));
  }
}

// Whoever thinks aloud is told on the terminal, and recorded.
TEST_F(OpenAiModelTest, KeyIsNotHeardInWhatTheModelSays) {
  const std::string key = "sk-0123456789abcdef";
  const std::string reply = stream_head + said("the key is sk-01234") + said("56789abcdef, so ") +
                            said("Response to user: 3") + stream_end;
  RudeServer server({sends(reply)});
  OpenAiModel model(settings(server.url(), key), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value()[0].reasoning, "the key is ***, so Response to user: 3");
  EXPECT_EQ(text_, replies.value()[0].reasoning);
}

TEST_F(OpenAiModelTest, WrongSettingsAreNamedWithoutARequest) {
  const auto refused = [&](const OpenAiModelSettings& wrong) {
    OpenAiModel model(wrong, clock_);
    return failure(model, Error::Code::malformed);
  };
  EXPECT_THAT(refused(settings("http://10.0.0.7/v1", "sk-1234567890")), HasSubstr("want https"));
  EXPECT_THAT(refused(settings("https://me:secret@host/v1")), Not(HasSubstr("secret")));
  EXPECT_THAT(refused(settings("host/v1")), HasSubstr("want http:// or https://"));
  EXPECT_THAT(refused(settings("https://host/v1", "a\r\nHost: other")),
              AllOf(HasSubstr("key"), Not(HasSubstr("Host"))));
  EXPECT_THAT(refused({.url = "https://host/v1", .model = ""}), HasSubstr("name of a model"));
  EXPECT_EQ(OpenAiModel(settings("https://me:secret@host/v1"), clock_).description(),
            "small at https://***@host/v1");
}

TEST_F(OpenAiModelTest, EnvironmentsProxyIsNotAsked) {
  RudeServer proxy({sends(good_reply(1))});
  RudeServer server({sends(good_reply(2))});
  setenv("http_proxy", proxy.url().c_str(), 1);  // NOLINT: no other thread reads it
  OpenAiModel model(settings(server.url()), clock_);
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
  unsetenv("http_proxy");  // NOLINT
  EXPECT_EQ(proxy.num_requests(), 0U);
}

TEST_F(OpenAiModelTest, LocalhostIsThisMachineWhateverLookUpsSay) {
  RudeServer server({sends(good_reply(2))});
  std::string url = server.url();
  url.replace(url.find("127.0.0.1"), 9, "localhost");  // which getaddrinfo below does not know
  OpenAiModel model(settings(url, "sk-0123456789"), clock_);
  EXPECT_TRUE(model.ask({"a"}, deadline, record_).has_value());
}

// Encrypted connections, to OpenSSL's own server with a certificate made for the test.

class OpenAiModelTlsTest : public OpenAiModelTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(openssl)) {
      GTEST_SKIP() << "want " << openssl;
    }
    std::string pattern = testing::TempDir() + "saca_tls_XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    server_.reset();
    std::filesystem::remove_all(folder_);
  }
  // @param host  that the certificate is for: "IP:127.0.0.1", "DNS:localhost"
  void serve(const std::string& host) {
    ChildProcess maker(
        {openssl, "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
         "-nodes", "-days", "2", "-subj", "/CN=test", "-addext", "subjectAltName=" + host,
         "-keyout", key_file(), "-out", certificate()},
        real_);
    ASSERT_FALSE(maker.start().has_value());
    while (maker.receive(real_.now() + 1000s).has_value()) {
    }
    server_.emplace(std::vector<std::string>{openssl, "s_server", "-accept", "127.0.0.1:0", "-key",
                                             key_file(), "-cert", certificate(), "-crlf"},
                    real_);
    ASSERT_FALSE(server_->start().has_value());
    constexpr std::string_view accepts = "ACCEPT 127.0.0.1:";
    for (auto line = server_->receive(real_.now() + 1000s);;
         line = server_->receive(real_.now() + 1000s)) {
      ASSERT_TRUE(line.has_value()) << line.error().message;
      if (line.value().starts_with(accepts)) {
        port_ = line.value().substr(accepts.size());
        return;
      }
    }
  }
  [[nodiscard]] std::string key_file() const { return folder_ + "/key.pem"; }
  [[nodiscard]] std::string certificate() const { return folder_ + "/certificate.pem"; }
  [[nodiscard]] OpenAiModelSettings settings_of(const std::string& authorities) {
    OpenAiModelSettings result = settings("https://127.0.0.1:" + port_ + "/v1", "sk-0123456789");
    result.authorities = authorities;
    return result;
  }

  static constexpr const char* openssl = "/usr/bin/openssl";
  SteadyClock real_;
  std::string folder_;
  std::string port_;
  std::optional<ChildProcess> server_;
};

TEST_F(OpenAiModelTlsTest, UnknownCertificateIsRefused) {
  serve("IP:127.0.0.1");
  OpenAiModel model(settings_of(""), clock_);
  EXPECT_THAT(failure(model), AllOf(HasSubstr("https://127.0.0.1:"), HasSubstr("certificate")));
}

TEST_F(OpenAiModelTlsTest, CertificateOfAnotherHostIsRefused) {
  serve("DNS:other.test");
  OpenAiModel model(settings_of(certificate()), clock_);
  EXPECT_THAT(failure(model), HasSubstr("127.0.0.1"));
}

TEST_F(OpenAiModelTlsTest, MissingAuthoritiesAreNamed) {
  serve("IP:127.0.0.1");
  OpenAiModel model(settings_of(folder_ + "/none.pem"), clock_);
  EXPECT_THAT(failure(model), HasSubstr("none.pem"));
}

TEST_F(OpenAiModelTlsTest, KnownCertificateIsTrusted) {
  serve("IP:127.0.0.1");
  std::thread answering([this] {  // what the server is told it sends
    auto line = server_->receive(real_.now() + 1000s);
    while (line.has_value() && !line.value().starts_with("Content-Length")) {
      line = server_->receive(real_.now() + 1000s);
    }
    EXPECT_FALSE(server_->send(good_reply(2), real_.now() + 1000s).has_value());
  });
  OpenAiModel model(settings_of(certificate()), clock_);
  const auto replies = model.ask({"a"}, deadline, record_);
  answering.join();
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  EXPECT_EQ(replies.value()[0].answers.at(0).probability[2], 1.0);
}

}  // namespace
}  // namespace saca::language_model::openai_model_test

// Instead of the system's, for this program: curl calls it on a thread of its own.
extern "C" int getaddrinfo(const char*, const char*, const addrinfo*, addrinfo**) {
  ++saca::language_model::openai_model_test::num_looking_up;
  while (saca::language_model::openai_model_test::look_up_hangs) {
    std::this_thread::yield();
  }
  --saca::language_model::openai_model_test::num_looking_up;
  return EAI_NONAME;
}
