#include "saca/thinking/memory/sqlite_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "saca/thinking/memory/cases_for_test.h"

namespace saca::memory::sqlite_table_test {
namespace {

namespace fs = std::filesystem;

class SqliteFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::path(testing::TempDir()) / "saca_sqlite_table.db";
    fs::remove(path_);
    table_ = open_sqlite(path_).value();
  }
  void TearDown() override { fs::remove(path_); }

  match::CaseId add(std::uint32_t seed) {
    match::CaseId id = 0;
    EXPECT_EQ(table_->in_one_transaction([&]() -> std::optional<Error> {
      id = table_->insert(cells_of(example_case(seed)), std::nullopt).value();
      return std::nullopt;
    }),
              std::nullopt);
    return id;
  }

  static std::vector<match::CaseId> ids_of(CaseTable& table) {
    std::vector<match::CaseId> ids;
    EXPECT_EQ(table.each_after(0,
                               [&](match::CaseId id, const Cells&) -> std::optional<Error> {
                                 ids.push_back(id);
                                 return std::nullopt;
                               }),
              std::nullopt);
    return ids;
  }

  fs::path path_;
  std::unique_ptr<CaseTable> table_;
};

TEST_F(SqliteFile, TakesBackAWholeTransaction) {
  add(1);
  const Error wanted{Error::Code::out_of_range, "not today"};
  const auto error = table_->in_one_transaction([&]() -> std::optional<Error> {
    EXPECT_TRUE(table_->insert(cells_of(example_case(2)), std::nullopt).has_value());
    EXPECT_EQ(table_->remove(1), std::nullopt);
    return wanted;
  });
  EXPECT_EQ(error, wanted);
  EXPECT_EQ(ids_of(*table_), std::vector<match::CaseId>{1});
}

TEST_F(SqliteFile, GivesNoIdTwice) {
  add(1);
  add(2);
  EXPECT_EQ(table_->in_one_transaction([&] { return table_->remove(2); }), std::nullopt);
  EXPECT_EQ(add(3), 3);
}

TEST_F(SqliteFile, EndsReadingWhereItIsTold) {
  add(1);
  add(2);
  int num_seen = 0;
  const Error enough{Error::Code::too_late, "enough"};
  EXPECT_EQ(table_->each_after(0,
                               [&](match::CaseId, const Cells&) -> std::optional<Error> {
                                 ++num_seen;
                                 return enough;
                               }),
            enough);
  EXPECT_EQ(num_seen, 1);
}

TEST_F(SqliteFile, ACopyOfAnotherTableHasItsRowsAndTakesNoMore) {
  add(1);
  add(2);
  EXPECT_EQ(table_->in_one_transaction([&] { return table_->remove(1); }), std::nullopt);
  const auto copy = copy_of(*table_).value();
  EXPECT_EQ(copy->name(), table_->name());
  EXPECT_EQ(ids_of(*copy), std::vector<match::CaseId>{2});
  EXPECT_EQ(copy->find(2).value(), table_->find(2).value());
  const auto refused = copy->in_one_transaction([&]() -> std::optional<Error> {
    const auto id = copy->insert(cells_of(example_case(3)), std::nullopt);
    return id.has_value() ? std::nullopt : std::optional(id.error());
  });
  ASSERT_TRUE(refused.has_value());
  EXPECT_EQ(refused->code, Error::Code::unwritable);
  EXPECT_EQ(ids_of(*copy), std::vector<match::CaseId>{2});
}

}  // namespace
}  // namespace saca::memory::sqlite_table_test
