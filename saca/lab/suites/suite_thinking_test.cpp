#include "saca/lab/suites/suite_thinking.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "saca/thinking/language_model/scripted_model.h"
#include "saca/thinking/memory/cases_for_test.h"

namespace saca::suites::suite_thinking_test {
namespace {

using language_model::LanguageModel;
using language_model::ScriptedModel;
using testing::HasSubstr;
using testing::MatchesRegex;

/// Opens models that choose braking, and remembers what it was asked for.
class SuiteThinkingTest : public testing::Test {
 protected:
  Result<std::unique_ptr<SuiteThinking>> open(const ThinkingOptions& options, int threads = 1) {
    return SuiteThinking::open(
        options,
        [this](const std::string& choice,
               const char* option) -> Result<std::unique_ptr<LanguageModel>> {
          asked_.push_back(std::string(option) + " " + choice);
          if (choice == "none") {
            return Error{Error::Code::unreadable, std::string(option) + ": there is none"};
          }
          return std::unique_ptr<LanguageModel>(
              std::make_unique<ScriptedModel>(manoeuvre::PolicyId::aeb, clock_));
        },
        {}, threads, clock_);
  }

  SteadyClock clock_;
  std::vector<std::string> asked_;
};

TEST_F(SuiteThinkingTest, WithoutAnythingLendsTheSetupAsItIs) {
  const auto thinking = open({});
  ASSERT_TRUE(thinking.has_value()) << thinking.error().message;
  SuiteThinking& none = *thinking.value();
  EXPECT_FALSE(none.has_model());
  EXPECT_EQ(none.memory_text(), std::nullopt);
  EXPECT_EQ(none.model_text(), std::nullopt);
  EXPECT_EQ(none.untuned(), nullptr);
  EXPECT_EQ(none.experience(), nullptr);
  EXPECT_EQ(none.failure(), std::nullopt);
  const SuiteThinking::Loan loan = none.lend({.clock = &clock_});
  EXPECT_EQ(loan.setup.clock, &clock_);
  EXPECT_EQ(loan.setup.memory, nullptr);
  EXPECT_EQ(loan.setup.model, nullptr);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(SuiteThinkingTest, OpensModelsAsTheyWereNamed) {
  const auto thinking = open({.memory = "", .model = "local", .untuned = "local:other"});
  ASSERT_TRUE(thinking.has_value()) << thinking.error().message;
  EXPECT_THAT(asked_, testing::ElementsAre("--llm local", "--untuned local:other"));
  EXPECT_TRUE(thinking.value()->has_model());
  EXPECT_EQ(thinking.value()->model_text(), "script");
  EXPECT_NE(thinking.value()->untuned(), nullptr);
  const SuiteThinking::Loan loan = thinking.value()->lend({});
  EXPECT_NE(loan.setup.model, nullptr);
  EXPECT_NE(loan.setup.model, thinking.value()->untuned());
}

TEST_F(SuiteThinkingTest, WithoutAModelThatWasNamedThereIsNothing) {
  const auto thinking = open({.memory = "", .model = "off", .untuned = "none"});
  ASSERT_FALSE(thinking.has_value());
  EXPECT_EQ(thinking.error().message, "--untuned: there is none");
}

TEST_F(SuiteThinkingTest, EachThreadHasACopyOfMemory) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "saca_suite_thinking_test.db";
  std::filesystem::remove(file);
  {
    memory::Store bank = memory::Store::open(file).value();
    ASSERT_TRUE(bank.add(memory::example_case(1)).has_value());
  }
  const auto thinking = open({.memory = file, .model = "off", .untuned = ""}, 2);
  ASSERT_TRUE(thinking.has_value()) << thinking.error().message;
  EXPECT_THAT(thinking.value()->memory_text().value_or(""),
              MatchesRegex("1 cases \\([0-9a-f]{16}\\)"));
  EXPECT_NE(thinking.value()->experience(), nullptr);
  const SuiteThinking::Loan one = thinking.value()->lend({});
  const SuiteThinking::Loan other = thinking.value()->lend({});
  ASSERT_NE(one.setup.memory, nullptr);
  ASSERT_NE(other.setup.memory, nullptr);
  EXPECT_NE(one.setup.memory, other.setup.memory);
  EXPECT_EQ(one.setup.memory->size(), 1U);
  std::filesystem::remove(file);
}

TEST_F(SuiteThinkingTest, ABankThatIsNotThereIsToldByItsOption) {
  const auto thinking = open({.memory = "no_such_bank.db", .model = "off", .untuned = ""});
  ASSERT_FALSE(thinking.has_value());
  EXPECT_THAT(thinking.error().message, HasSubstr("--memory: "));
}

}  // namespace
}  // namespace saca::suites::suite_thinking_test
