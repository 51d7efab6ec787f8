#include "saca/memory/sqlite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace saca::memory::sqlite_test {
namespace {

using testing::HasSubstr;

Database empty_database() {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(":memory:", &database), SQLITE_OK);
  return Database(database);
}

TEST(Statement, GivesBackWhatWasBound) {
  const Database database = empty_database();
  const std::string text("a\0b", 3);
  Statement statement(database.get(), "SELECT ?1, ?2, ?3, ?4 AS missing");
  statement.bind(1, std::int64_t{1} << 60).bind(2, 0.1).bind(3, text);
  ASSERT_EQ(statement.step(), SQLITE_ROW);
  EXPECT_EQ(statement.integer(0), std::int64_t{1} << 60);
  EXPECT_EQ(statement.number(1), 0.1);
  EXPECT_EQ(statement.text(2), text);
  EXPECT_EQ(statement.type(3), SQLITE_NULL);
  EXPECT_EQ(statement.text(3), "");
  EXPECT_EQ(statement.name(3), "missing");
  EXPECT_EQ(statement.step(), SQLITE_DONE);
}

TEST(Statement, FailsWhenItCannotBePrepared) {
  const Database database = empty_database();
  Statement statement(database.get(), "SELECT harm FROM cases");
  EXPECT_EQ(statement.bind(1, 0.1).step(), SQLITE_ERROR);
  const Error error = sqlite_problem(database.get(), "bank.db", Access::read);
  EXPECT_EQ(error.code, Error::Code::malformed);
  EXPECT_THAT(error.message, HasSubstr("bank.db"));
  EXPECT_THAT(error.message, HasSubstr("no such table: cases"));
}

TEST(SqliteProblem, OfAFileThatAnotherHoldsIsThatItIsTooLate) {
  const std::string path = testing::TempDir() + "saca_sqlite_held.db";
  std::remove(path.c_str());
  sqlite3* first = nullptr;
  sqlite3* second = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &first), SQLITE_OK);
  ASSERT_EQ(sqlite3_open(path.c_str(), &second), SQLITE_OK);
  const Database holder(first);
  const Database waiter(second);
  ASSERT_EQ(Statement(holder.get(), "BEGIN EXCLUSIVE").step(), SQLITE_DONE);
  ASSERT_EQ(Statement(waiter.get(), "BEGIN EXCLUSIVE").step(), SQLITE_BUSY);
  const Error error = sqlite_problem(waiter.get(), "bank.db", Access::write);
  EXPECT_EQ(error.code, Error::Code::too_late);
  EXPECT_THAT(error.message, HasSubstr("bank.db: cannot be written: another process"));
  std::remove(path.c_str());
}

}  // namespace
}  // namespace saca::memory::sqlite_test
