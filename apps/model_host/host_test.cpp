// The real model through the real child process; skipped where `make model` has not been run.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply_grammar.h"
#include "saca/thinking/language_model/token_bound.h"
#include "saca/thinking/language_model/truth.h"

namespace saca::model_host::host_test {
namespace {

using namespace std::chrono_literals;
using language_model::Answer;

constexpr int chat_tokens = 8;    // that the template puts around a scene
constexpr auto patience = 25min;  // a busy machine is slow; nothing here is about speed

class HostTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(SACA_MODEL)) {
      GTEST_SKIP() << SACA_MODEL << " is not there";
    }
    situation_.posteriors[0][0] = 0.88;
    scene_ = language_model::scene_part(situation_, std::nullopt, 0.0);
  }

  /// One thread: two that meet at each step take three times as long where somebody else computes.
  [[nodiscard]] language_model::ChildModelSettings settings(int max_tokens) const {
    return {.command = {SACA_MODEL_HOST, "--threads", "1", "--model", SACA_MODEL},
            .system = language_model::system_part(prepare::read_harm(SACA_HARM).value()),
            .identity = "base",
            .max_tokens = max_tokens};
  }

  SteadyClock clock_;
  preview::Situation situation_ = language_model::example_situation();
  std::string scene_;
  std::function<void(const language_model::Progress&)> nobody_ =
      [](const language_model::Progress&) {};
};

TEST_F(HostTest, WithdrawnQuestionLeavesTheModelReady) {
  constexpr int most = 30;  // a reply of the shipped weights is longer
  language_model::ChildModelSettings patient = settings(most);
  patient.margin = 100.0;  // a busy machine may be slow to stop
  language_model::ChildModel model(patient, clock_);
  const auto alone = model.ask({scene_}, clock_.now() + patience, nobody_);
  for (const bool while_it_reads : {true, false}) {
    std::stop_source stop;
    if (while_it_reads) {
      stop.request_stop();
    }
    const auto at_first_word = [&](const language_model::Progress& p) {
      if (!p.text.empty()) {
        stop.request_stop();
      }
    };
    const auto replies = model.ask({scene_, scene_}, clock_.now() + patience, at_first_word,
                                   {.stop = stop.get_token()});
    if (while_it_reads) {
      ASSERT_FALSE(replies.has_value());
      EXPECT_EQ(replies.error().code, Error::Code::too_late);
    } else {
      ASSERT_TRUE(replies.has_value()) << replies.error().message;
      EXPECT_FALSE(replies.value()[0].answers.empty());
      EXPECT_LT(replies.value()[0].reply_tokens, most);
    }
  }
  const auto again = model.ask({scene_}, clock_.now() + patience, nobody_);
  ASSERT_TRUE(alone.has_value() && again.has_value());
  EXPECT_EQ(alone.value()[0].reply_tokens, most);
  EXPECT_EQ(alone.value()[0].reasoning, again.value()[0].reasoning);
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(HostTest, SameQuestionSameReply) {
  language_model::ChildModel model(settings(6), clock_);
  const auto once = model.ask({scene_, scene_}, clock_.now() + patience, nobody_);
  const auto again = model.ask({scene_, scene_}, clock_.now() + patience, nobody_);
  ASSERT_TRUE(once.has_value()) << once.error().message;
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(once.value()[0].reply_tokens, 6);
  EXPECT_FALSE(once.value()[0].reasoning.empty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(once.value()[i].reasoning, again.value()[i].reasoning);
    ASSERT_EQ(once.value()[i].answers.size(), 2U);
    EXPECT_EQ(once.value()[i].answers[0].kind, Answer::Kind::first);
    EXPECT_EQ(once.value()[i].answers[1].kind, Answer::Kind::forced);  // cut by max_tokens
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(once.value()[i].answers[k].probability, again.value()[i].answers[k].probability);
    }
  }
  EXPECT_EQ(model.restarts(), 0);
}

TEST_F(HostTest, ASeedDrawsAnotherReplyAndAlwaysTheSame) {
  language_model::ChildModel model(settings(24), clock_);
  const auto reasoning = [&](int seed) {
    const auto replies =
        model.ask({scene_}, clock_.now() + patience, nobody_, {.sampling_seed = seed});
    EXPECT_TRUE(replies.has_value()) << replies.error().message;
    return replies.has_value() ? replies.value()[0].reasoning : std::string();
  };
  std::set<std::string> drawn;
  for (const int seed : {0, 1, 2, 3}) {
    drawn.insert(reasoning(seed));
  }
  EXPECT_GT(drawn.size(), 1U);
  EXPECT_EQ(reasoning(3), reasoning(3));
}

// What replies may say, whatever the weights would write; the answer after it is theirs.
TEST_F(HostTest, AReplyKeepsToItsGrammar) {
  language_model::ChildModel model(settings(24), clock_);
  const auto ask = [&](int seed) {
    return model.ask({scene_, scene_, scene_}, clock_.now() + patience, nobody_,
                     {.sampling_seed = seed,
                      .grammars = {"root ::= (\"Brake\" | \"Steer\") \"!\\nResponse to user:\"\n",
                                   "", "root ::= \"Enough.\"\n"}});
  };
  for (const int seed : {0, 1}) {
    const auto replies = ask(seed);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    const std::string& text = replies.value()[0].reasoning;
    EXPECT_TRUE(text == "Brake!\nResponse to user:" || text == "Steer!\nResponse to user:") << text;
    EXPECT_EQ(replies.value()[0].answers.back().kind, Answer::Kind::ended);
    EXPECT_EQ(replies.value()[1].reply_tokens, 24) << "no grammar";
    EXPECT_EQ(replies.value()[2].reasoning, "Enough.");
    EXPECT_EQ(replies.value()[2].answers.back().kind, Answer::Kind::ended);
  }
  EXPECT_EQ(ask(1).value()[0].reasoning, ask(1).value()[0].reasoning);
  const auto refused =
      model.ask({scene_}, clock_.now() + patience, nobody_, {.grammars = {"root ::= ("}});
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("grammar"), std::string::npos) << refused.error().message;
  EXPECT_EQ(model.restarts(), 0);
}

// The grammar that SACA gives is one that the library reads; what comes of it is true.
TEST_F(HostTest, AReplyHeldToWhatIsTrueIsTrue) {
  constexpr int most = 112;
  language_model::ChildModel model(settings(most), clock_);
  const auto replies =
      model.ask({scene_}, clock_.now() + patience, nobody_,
                {.grammars = {language_model::reply_grammar(situation_, scene_, std::nullopt)}});
  ASSERT_TRUE(replies.has_value()) << replies.error().message;
  const language_model::Reply& reply = replies.value()[0];
  EXPECT_EQ(reply.answers.back().kind, Answer::Kind::ended) << reply.reasoning;
  const language_model::Truth truth = language_model::truth_of(reply, scene_, situation_);
  EXPECT_GE(truth.num_checked, 1);
  EXPECT_TRUE(truth.wrong.empty()) << reply.reasoning;
}

// Shared prefix or not, alone or beside others: a scene's first answer is its own.
TEST_F(HostTest, OtherScenesDoNotChangeAFirstAnswer) {
  situation_.scene_at_trigger.ego.v_B.x = 9.0;
  const std::string other = language_model::scene_part(situation_, std::nullopt, 0.0);
  language_model::ChildModel model(settings(0), clock_);
  const auto alone = model.ask({scene_}, clock_.now() + patience, nobody_);
  const auto beside = model.ask({other, scene_}, clock_.now() + patience, nobody_);
  ASSERT_TRUE(alone.has_value() && beside.has_value());
  ASSERT_EQ(beside.value()[1].answers.size(), 1U);
  EXPECT_EQ(alone.value()[0].answers[0].probability, beside.value()[1].answers[0].probability);
  EXPECT_NE(alone.value()[0].answers[0].probability, beside.value()[0].answers[0].probability);
}

// What the tokeniser says, not we. Reading takes its time: `make soak` looks at more scenes.
TEST_F(HostTest, NoPromptIsLongerThanItsBound) {
  language_model::ChildModel model(settings(0), clock_);
  std::vector<std::string> scenes{scene_};
  const unsigned num_seeds = std::getenv("SACA_SOAK_ASKS") != nullptr ? 50 : 4;
  for (unsigned seed = 0; seed < num_seeds; ++seed) {
    memory::Case nearest;
    nearest.harm = 0.0321;
    nearest.best_harm = 1.25;
    scenes.push_back(
        language_model::scene_part(language_model::crowded_situation(seed), nearest, 0.5));
  }
  for (const std::string& scene : scenes) {
    const auto replies = model.ask({scene}, clock_.now() + patience, nobody_);
    ASSERT_TRUE(replies.has_value()) << replies.error().message;
    const int tokens = replies.value()[0].prompt_tokens;
    EXPECT_LE(tokens, language_model::tokens_at_most(scene) + chat_tokens) << scene;
    EXPECT_GE(tokens, language_model::tokens_at_most(scene) * 9 / 10)
        << "the bound wastes much: " << scene;
    EXPECT_LE(tokens, language_model::most_prompt_tokens + chat_tokens) << scene;
  }
}

// However much a grammar forces at once, and wherever that must end.
TEST_F(HostTest, WhatMustComeKeepsToEveryBound) {
  std::string very_long;
  for (int k = 0; k < 100; ++k) {
    very_long += "The truck is near. ";
  }
  const auto ask = [&](int max_tokens, const std::vector<std::string>& grammars) {
    language_model::ChildModel model(settings(max_tokens), clock_);
    const std::vector<std::string> scenes(grammars.size(), scene_);
    auto replies = model.ask(scenes, clock_.now() + patience, nobody_, {.grammars = grammars});
    EXPECT_EQ(model.restarts(), 0);
    return replies;
  };
  // More than fits into a step, three times.
  const std::string endless = "root ::= \"" + very_long + "\"\n";
  const auto many = ask(400, {endless, endless, endless});
  ASSERT_TRUE(many.has_value()) << many.error().message;
  for (const language_model::Reply& reply : many.value()) {
    EXPECT_EQ(reply.reply_tokens, 400);
    EXPECT_TRUE(very_long.starts_with(reply.reasoning)) << reply.reasoning;
    EXPECT_EQ(reply.answers.back().kind, Answer::Kind::forced);
  }
  // As much as is asked for; up to the answer; in whole characters.
  const auto some = ask(7, {endless, "root ::= \"Go.\\nResponse to user: 3 and more\"\n",
                            "root ::= \"caf\" (\"\u00e9\" | \"\u00e8\")\n"});
  ASSERT_TRUE(some.has_value()) << some.error().message;
  EXPECT_EQ(some.value()[0].reply_tokens, 7);
  EXPECT_EQ(some.value()[0].answers.back().kind, Answer::Kind::forced);
  EXPECT_EQ(some.value()[1].reasoning, "Go.\nResponse to user:");
  EXPECT_EQ(some.value()[1].answers.back().kind, Answer::Kind::ended);
  EXPECT_TRUE(some.value()[2].reasoning == "caf\u00e9" || some.value()[2].reasoning == "caf\u00e8")
      << some.value()[2].reasoning;
}

// Text that a grammar leaves no choice about is not asked for, token by token. The same grammar
// written with more of the notation, which nobody here follows, leads to the same text.
TEST_F(HostTest, WhatMustComeIsWrittenAsIfItHadBeenChosen) {
  language_model::ChildModel model(settings(112), clock_);
  for (const unsigned seed : {0U, 1U, 2U}) {
    const preview::Situation situation =
        seed == 0 ? situation_ : language_model::crowded_situation(seed);
    const std::string scene = language_model::scene_part(situation, std::nullopt, 0.0);
    const std::string grammar = language_model::reply_grammar(situation, scene, std::nullopt);
    const auto followed =
        model.ask({scene}, clock_.now() + patience, nobody_, {.grammars = {grammar}});
    const auto by_token = model.ask({scene}, clock_.now() + patience, nobody_,
                                    {.grammars = {grammar + "unused ::= [a-z]\n"}});
    ASSERT_TRUE(followed.has_value()) << followed.error().message;
    ASSERT_TRUE(by_token.has_value()) << by_token.error().message;
    const language_model::Reply& reply = followed.value()[0];
    EXPECT_EQ(reply.reasoning, by_token.value()[0].reasoning);
    EXPECT_EQ(reply.reply_tokens, by_token.value()[0].reply_tokens) << reply.reasoning;
    EXPECT_EQ(reply.answers.back().kind, Answer::Kind::ended);
    EXPECT_EQ(reply.answers.size(), by_token.value()[0].answers.size());
  }
}

TEST_F(HostTest, KilledInTheMiddleItAnswersTheNextQuestion) {
  language_model::ChildModel model(settings(500), clock_);
  const auto cut =
      model.ask({scene_}, clock_.now() + patience, [&](const language_model::Progress& p) {
        if (p.answer != nullptr) {
          kill(model.pid().value(), SIGKILL);
        }
      });
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut.value()[0].answers.size(), 1U);
  EXPECT_EQ(model.restarts(), 1);
  model.kill();
}

TEST_F(HostTest, PromptThatDoesNotFitIsRefused) {
  language_model::ChildModel model(settings(6), clock_);
  std::string endless;
  for (int i = 0; i < 2000; ++i) {
    endless += "car ";
  }
  const auto refused = model.ask({endless}, clock_.now() + patience, nobody_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("want at most"), std::string::npos);
  EXPECT_TRUE(model.ask({scene_}, clock_.now() + patience, nobody_).has_value());
  EXPECT_EQ(model.restarts(), 0);
}

// Whatever is wrong with a file: it is named, and nobody waits or dies but the child.
TEST_F(HostTest, WrongWeightsAreNamed) {
  const std::filesystem::path folder = testing::TempDir();
  const auto refused = [&](const std::filesystem::path& weights) {
    language_model::ChildModelSettings wrong = settings(6);
    wrong.command.back() = weights;
    language_model::ChildModel model(wrong, clock_);
    const auto replies = model.ask({scene_}, clock_.now() + patience, nobody_);
    std::filesystem::remove(weights);
    return replies.has_value() ? "it answered" : replies.error().message;
  };
  const auto expect_named = [&](const std::filesystem::path& weights) {
    EXPECT_NE(refused(weights).find(weights.string()), std::string::npos) << weights;
  };
  expect_named("/no/such/weights.gguf");

  const auto text = folder / "saca_text.gguf";
  ASSERT_FALSE(write_file(text, "this is no model").has_value());
  expect_named(text);

  const auto cut = folder / "saca_cut.gguf";
  std::filesystem::copy_file(SACA_MODEL, cut, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  expect_named(cut);

  // Whole, of an architecture that nobody knows, without tensors.
  const auto foreign = folder / "saca_foreign.gguf";
  const auto number = [](std::uint64_t value, int bytes) {
    std::string little;
    for (int i = 0; i < bytes; ++i, value >>= 8U) {
      little += static_cast<char>(value & 0xFFU);
    }
    return little;
  };
  const auto word = [&](const std::string& its) { return number(its.size(), 8) + its; };
  ASSERT_FALSE(write_file(foreign, "GGUF" + number(3, 4) + number(0, 8) + number(1, 8) +
                                       word("general.architecture") + number(8, 4) +
                                       word("cuneiform"))
                   .has_value());
  expect_named(foreign);

  const auto huge = folder / "saca_huge.gguf";
  ASSERT_FALSE(write_file(huge, "GGUF").has_value());
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 40U);  // holes: it takes no room
  EXPECT_NE(refused(huge).find("half of the memory"), std::string::npos);
}

}  // namespace
}  // namespace saca::model_host::host_test
