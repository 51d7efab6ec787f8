#include "saca/lab/runs/bank.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/thinking/memory/cases_for_test.h"

namespace saca::runs::bank_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class ABank : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "runs_bank_test";
  int asked_ = 0;
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] BankRequest request(BankUse use, const std::string& file = "bank.sqlite") {
    return {.place = (folder_ / file).string(),
            .use = use,
            .car = {},
            .shipped = [this]() -> Result<std::vector<memory::Case>> {
              ++asked_;
              std::vector cases{memory::example_case(1), memory::example_case(2)};
              cases[0].id = 1;
              cases[1].id = 2;
              return cases;
            }};
  }
};

TEST_F(ABank, ThatIsNewBeginsWithWhatIsShipped) {
  ASSERT_TRUE(open_bank(request(BankUse::learn)).has_value());
  EXPECT_EQ(open_bank(request(BankUse::learn)).value()->size(), 2U);
  EXPECT_EQ(asked_, 1);  // the second time it is not empty
}

TEST_F(ABank, MayBeginEmpty) {
  const auto bank = open_bank(request(BankUse::learn_from_empty)).value();
  EXPECT_EQ(bank->size(), 0U);
  EXPECT_EQ(asked_, 0);
  EXPECT_TRUE(bank->add(memory::example_case(3)).has_value());
}

TEST_F(ABank, ThatIsOnlyAskedIsNeitherMadeNorAddedTo) {
  const Error missing = open_bank(request(BankUse::ask)).error();
  EXPECT_THAT(missing.message, AllOf(HasSubstr("bank.sqlite"), HasSubstr(" (run without --memory)"),
                                     Not(HasSubstr("move the file"))));
  EXPECT_FALSE(fs::exists(folder_ / "bank.sqlite"));
  ASSERT_TRUE(open_bank(request(BankUse::learn_from_empty)).has_value());
  const auto bank = open_bank(request(BankUse::ask)).value();
  EXPECT_EQ(bank->size(), 0U);
  EXPECT_EQ(asked_, 0);
  EXPECT_FALSE(bank->add(memory::example_case(3)).has_value());
}

TEST_F(ABank, NeedsItsFolderWhereItLearns) {
  const Error problem = open_bank(request(BankUse::learn, "no/bank.sqlite")).error();
  EXPECT_EQ(problem.code, Error::Code::unreadable);
  EXPECT_EQ(problem.message, "--memory " + (folder_ / "no/bank.sqlite").string() +
                                 ": want a folder that is there, got " + (folder_ / "no").string());
}

TEST_F(ABank, ThatIsDamagedOrCannotBeginTellsAWayOut) {
  ASSERT_EQ(write_file(folder_ / "bank.sqlite", "no bank at all, and long enough to be looked at"),
            std::nullopt);
  EXPECT_THAT(open_bank(request(BankUse::learn)).error().message,
              HasSubstr(" (move the file away, or run without --memory)"));
  BankRequest unshipped = request(BankUse::learn, "other.sqlite");
  unshipped.shipped = []() -> Result<std::vector<memory::Case>> {
    return Error{Error::Code::unreadable, "seed.jsonl.gz: nothing"};
  };
  EXPECT_EQ(open_bank(unshipped).error().message, "seed.jsonl.gz: nothing");
}

}  // namespace
}  // namespace saca::runs::bank_test
