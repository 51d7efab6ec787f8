#include "saca/thinking/memory/sqlite.h"

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

TEST(Statement, GivesUpWhatTakesTooMuchWork) {
  const Database database = empty_database();
  const char* const endless =
      "WITH RECURSIVE r(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM r) SELECT count(*) FROM r";
  EXPECT_EQ(Statement(database.get(), endless, 10'000).step(), SQLITE_INTERRUPT);
  const Error error = sqlite_problem(database.get(), "bank.db", Access::read);
  EXPECT_EQ(error.code, Error::Code::malformed);
  EXPECT_THAT(error.message,
              HasSubstr("bank.db: want a memory bank, got what takes too much work"));
  EXPECT_EQ(Statement(database.get(), "SELECT 1").step(), SQLITE_ROW);
}

TEST(Wariness, RunsNoViewAndNoTrigger) {
  const Database database = empty_database();
  const auto run = [&](const char* sql) {
    return sqlite3_exec(database.get(), sql, nullptr, nullptr, nullptr);
  };
  ASSERT_EQ(run("CREATE TABLE t (a); CREATE VIEW v AS SELECT 1;"
                "CREATE TRIGGER r AFTER INSERT ON t BEGIN DELETE FROM t; END"),
            SQLITE_OK);
  be_wary(database.get());
  EXPECT_NE(run("SELECT * FROM v"), SQLITE_OK);
  ASSERT_EQ(run("INSERT INTO t VALUES (1)"), SQLITE_OK);
  EXPECT_EQ(Statement(database.get(), "SELECT a FROM t").step(), SQLITE_ROW);
  EXPECT_NE(run("PRAGMA writable_schema = ON; DELETE FROM sqlite_schema"), SQLITE_OK);
  EXPECT_NE(run("SELECT zeroblob(17000000)"), SQLITE_OK);
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
