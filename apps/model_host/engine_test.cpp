// The real weights, by a clock of the test's own; skipped where `make model` has not been run.
#include "engine.h"

#include <gtest/gtest.h>
#include <llama.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/collision/harm.h"
#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/gbnf_for_test.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply_grammar.h"

namespace saca::model_host::engine_test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t num_scenes = 2;

/// Goes on by as much each time that it is looked at, as each step does about as often: what takes
/// how long hangs on the number of steps alone, not on the machine.
class CountingClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return now_ += 1us; }
  void wait_until(Time time) noexcept override { now_ = std::max(now_, time); }

 private:
  mutable Time now_{0};
};

class EngineTest : public testing::Test {
 protected:
  /// What was said of each scene.
  struct Said {
    std::array<std::string, num_scenes> texts;
    std::array<AnswerKind, num_scenes> last{};
    Clock::Time begun{0};  ///< from the question to the last first answer
    Clock::Time done{0};   ///< to the end

    [[nodiscard]] bool all(AnswerKind kind) const { return last == std::array{kind, kind}; }
    [[nodiscard]] std::size_t bytes() const { return texts[0].size() + texts[1].size(); }
  };

  void SetUp() override {
    if (!std::filesystem::exists(SACA_MODEL)) {
      GTEST_SKIP() << SACA_MODEL << " is not there";
    }
    llama_log_set([](ggml_log_level, const char*, void*) {}, nullptr);
    auto engine = Engine::load({.model_path = SACA_MODEL, .threads = 1, .gives_way = true});
    ASSERT_TRUE(engine.has_value()) << engine.error().message;
    engine_ = engine.value();
    const auto system = engine_->set_system(
        language_model::system_part(prepare::read_harm(SACA_HARM).value()), clock_);
    ASSERT_TRUE(system.has_value()) << system.error().message;
    for (unsigned seed = 1; seed <= num_scenes; ++seed) {
      const preview::Situation situation = language_model::crowded_situation(seed);
      scenes_.push_back(language_model::scene_part(situation, std::nullopt, 0.0));
      form_.grammars.push_back(
          language_model::reply_grammar(situation, scenes_.back(), std::nullopt));
    }
  }

  /// @param time  for all
  [[nodiscard]] Said ask(Clock::Time time) {
    Said said;
    const Clock::Time begin = clock_.now();
    const EngineEvents events{
        [](std::size_t, int) {},
        [&](std::size_t scene, std::string_view text) { said.texts.at(scene) += text; },
        [&](std::size_t scene, AnswerKind kind, const std::vector<double>&) {
          said.last.at(scene) = kind;
          if (kind == AnswerKind::first) {
            said.begun = clock_.now() - begin;
          }
        }};
    const auto figures = engine_->ask(scenes_, begin + time, form_, clock_, events);
    EXPECT_TRUE(figures.has_value()) << figures.error().message;
    said.done = clock_.now() - begin;
    return said;
  }

  CountingClock clock_;
  std::shared_ptr<Engine> engine_;
  std::vector<std::string> scenes_;
  ReplyForm form_{.max_tokens = 112};
};

// Where time is short replies leave out what they may, and are whole all the same.
TEST_F(EngineTest, RepliesAreBriefWhereTimeIsShort) {
  const Said patient = ask(1h);
  ASSERT_TRUE(patient.all(AnswerKind::ended));
  const Clock::Time replies = patient.done - patient.begun;

  const Said unhurried = ask(patient.begun + 3 * replies);
  EXPECT_EQ(unhurried.texts, patient.texts);

  const Said hurried = ask(patient.begun + replies);
  EXPECT_TRUE(hurried.all(AnswerKind::ended)) << hurried.texts[0];
  EXPECT_LT(hurried.bytes(), patient.bytes());
  for (std::size_t i = 0; i < num_scenes; ++i) {
    EXPECT_TRUE(language_model::Gbnf(form_.grammars[i]).accepts(hurried.texts.at(i)))
        << hurried.texts.at(i);
  }

  const Said cut = ask(patient.begun + replies / 10);
  EXPECT_FALSE(cut.all(AnswerKind::ended));
  EXPECT_LT(cut.bytes(), hurried.bytes());
}

}  // namespace
}  // namespace saca::model_host::engine_test
