#include "saca/lab/banks/bank_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::bank_files_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

TEST(ReadCases, OfSeveralFilesComeOneAfterTheOther) {
  const EmptyFolder folder;
  const std::vector<std::string> files{
      folder.with_cases("a", {best_is(PolicyId::aeb, 10.0, "one")}), folder.with_cases("none", {}),
      folder.with_cases(
          "b", {best_is(PolicyId::aeb, 11.0, "two"), best_is(PolicyId::aeb, 12.0, "three")})};
  const auto cases = read_cases(files).value();
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_EQ(cases[0].source, "one");
  EXPECT_EQ(cases[2].source, "three");
  EXPECT_TRUE(read_cases(std::vector<std::string>()).value().empty());
}

TEST(ReadCases, TellsWhichFileCannotBeRead) {
  const EmptyFolder folder;
  const auto missing = read_cases(std::vector<std::string>{folder.file("nowhere.jsonl")});
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, Error::Code::unreadable);
  EXPECT_THAT(missing.error().message, HasSubstr("nowhere.jsonl"));
  ASSERT_FALSE(write_file(folder.file("words"), "no cases\n"));
  const auto damaged = read_cases(folder.file("words"));
  ASSERT_FALSE(damaged.has_value());
  EXPECT_EQ(damaged.error().code, Error::Code::malformed);
}

TEST(ShippedCases, AreTrusted) {
  const auto cases = shipped_cases(".").value();
  EXPECT_GT(cases.size(), 5'000U);
  for (const memory::Case& one : cases) {
    ASSERT_EQ(one.trust, memory::Trust::trusted) << one.id;
  }
  EXPECT_FALSE(shipped_cases("no/such/folder").has_value());
}

TEST(Banks, AreMadeToBeAddedToAndNotToBeRead) {
  const EmptyFolder folder;
  const std::string place = folder.file("new/bank.sqlite");
  const auto none = read_bank(place);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, Error::Code::unreadable);
  EXPECT_FALSE(std::filesystem::exists(folder.file("new")));
  {
    auto store = open_to_add(place);
    ASSERT_TRUE(store.has_value());
    memory::Store memory = std::move(store).value();
    ASSERT_TRUE(memory.add(best_is(PolicyId::aeb, 10.0, "one")).has_value());
  }
  const auto bank = read_bank(place);
  ASSERT_TRUE(bank.has_value());
  ASSERT_EQ(bank.value().cases.size(), 1U);
  EXPECT_EQ(bank.value().cases[0].source, "one");
}

TEST(Banks, AreNotMadeWhereNoFolderCanBe) {
  const auto refused = open_to_add("/proc/nowhere/bank.sqlite");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::banks::bank_files_test
