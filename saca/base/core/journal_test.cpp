#include "saca/base/core/journal.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"

namespace saca::journal_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Journals : public testing::Test {
 protected:
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".journal");
  void SetUp() override { std::filesystem::remove_all(path_); }
  void TearDown() override { std::filesystem::remove_all(path_); }

  [[nodiscard]] std::vector<std::string> reopened() const {
    return Journal::open(path_, "work").value().lines();
  }
};

TEST_F(Journals, RememberWhatWasAdded) {
  {
    const Journal journal = Journal::open(path_, "work").value();
    EXPECT_THAT(journal.lines(), IsEmpty());
    EXPECT_TRUE(journal.add("one"));
    EXPECT_TRUE(journal.add(""));
    EXPECT_TRUE(journal.add("three"));
  }
  EXPECT_THAT(reopened(), ElementsAre("one", "", "three"));
}

TEST_F(Journals, DropALineThatWasCutShortAndGoOnAfterTheLastWhole) {
  ASSERT_EQ(write_file(path_, "work\none\ntw"), std::nullopt);
  {
    const Journal journal = Journal::open(path_, "work").value();
    EXPECT_THAT(journal.lines(), ElementsAre("one"));
    EXPECT_TRUE(journal.add("two"));
  }
  EXPECT_THAT(reopened(), ElementsAre("one", "two"));
}

TEST_F(Journals, BeginAnewWhereNotEvenTheTitleWasWritten) {
  ASSERT_EQ(write_file(path_, "wo"), std::nullopt);
  EXPECT_THAT(reopened(), IsEmpty());
}

TEST_F(Journals, RefuseAnothersWorkAndKeepIt) {
  (void)Journal::open(path_, "work of yesterday").value();
  const auto refused = Journal::open(path_, "work");
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message,
              AllOf(HasSubstr(path_.string()), HasSubstr("work of yesterday")));
  EXPECT_EQ(read_file(path_).value(), "work of yesterday\n");
}

TEST_F(Journals, RefuseAPlaceThatCannotBeWritten) {
  const auto refused = Journal::open("/no/such/folder/journal", "work");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::journal_test
