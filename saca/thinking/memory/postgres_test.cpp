#include "saca/thinking/memory/postgres.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "tests/support/postgres_server.h"

namespace saca::memory::postgres_test {
namespace {

using testing::HasSubstr;
using Kind = PostgresFailure::Kind;

TEST(PostgresUrl, IsToldFromAFile) {
  EXPECT_TRUE(is_postgres_url("postgresql://a/b"));
  EXPECT_TRUE(is_postgres_url("postgres://"));
  EXPECT_FALSE(is_postgres_url("postgresql"));
  EXPECT_FALSE(is_postgres_url("runs/memory.sqlite"));
  EXPECT_FALSE(is_postgres_url(""));
}

TEST(PostgresUrl, IsPrintedWithoutPassword) {
  EXPECT_EQ(printable_url("postgresql://me:secret@server:5433/fleet?sslmode=verify-full"),
            "postgresql://me@server:5433/fleet");
  EXPECT_EQ(printable_url("postgresql:///fleet?user=me&password=secret&host=/run/x"),
            "postgresql://me@/run/x/fleet");
  EXPECT_EQ(printable_url("postgresql://server"), "postgresql://server");
  EXPECT_EQ(printable_url("postgresql://me:secret@server:5433/fleet?no=such"), "postgresql://");
  EXPECT_THAT(printable_url("postgresql://a%0Ab/c"), testing::Not(HasSubstr("\n")));
}

PostgresConnection::Time in(std::chrono::milliseconds time) {
  return std::chrono::steady_clock::now() + time;
}
constexpr std::chrono::seconds long_enough{10};

class Connection : public testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = test::PostgresServer::start(); }
  static void TearDownTestSuite() { server_.reset(); }
  void SetUp() override {
    if (!server_) {
      GTEST_SKIP() << "PostgreSQL is not installed";
    }
    connection_ = std::make_unique<PostgresConnection>(server_->url());
    ASSERT_FALSE(connection_->open(in(long_enough)).has_value());
  }

  static std::unique_ptr<test::PostgresServer> server_;
  std::unique_ptr<PostgresConnection> connection_;
  Rows rows_;
};
std::unique_ptr<test::PostgresServer> Connection::server_;

TEST_F(Connection, GivesBackWhatWasSent) {
  const double awkward = 0.1 + 0.2;
  const std::array<Cell, 4> values{std::int64_t{1} << 60, awkward, std::string("a 'b' \xc3\xa4"),
                                   Cell()};
  ASSERT_FALSE(connection_->run("SELECT $1::bigint, $2::float8, $3::text, $4::text", values,
                                in(long_enough), rows_));
  ASSERT_EQ(rows_.size(), 1);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rows_.cell(0, i), values.at(static_cast<std::size_t>(i)));
  }
  EXPECT_EQ(rows_.integer(0, 0), std::int64_t{1} << 60);
  EXPECT_EQ(rows_.integer(0, 2), 0);
}

TEST_F(Connection, SendsAndReceivesMoreThanASocketHolds) {
  std::string text;
  text.resize(20'000'000, 'x');
  const Cell much = text;
  ASSERT_FALSE(connection_->run("SELECT $1::text", {&much, 1}, in(long_enough), rows_));
  EXPECT_EQ(rows_.cell(0, 0), much);
}

TEST_F(Connection, TellsWhatTheServerRefusesAndGoesOn) {
  const auto failure = connection_->run("SELECT harm FROM cases", {}, in(long_enough), rows_);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, Kind::refused);
  EXPECT_EQ(failure->state, "42P01");
  EXPECT_THAT(failure->why, HasSubstr("\"cases\" does not exist"));
  EXPECT_FALSE(connection_->run("SELECT 1", {}, in(long_enough), rows_).has_value());
}

TEST_F(Connection, WaitsNoLongerThanItMay) {
  const auto begin = std::chrono::steady_clock::now();
  const auto failure =
      connection_->run("SELECT pg_sleep(30)", {}, in(std::chrono::milliseconds(100)), rows_);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, Kind::late);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  EXPECT_FALSE(connection_->is_open());
}

TEST_F(Connection, TellsThatTheServerHasEndedIt) {
  ASSERT_FALSE(connection_->run("SELECT pg_backend_pid()", {}, in(long_enough), rows_));
  const Cell process = rows_.cell(0, 0);
  PostgresConnection other(server_->url());
  ASSERT_FALSE(other.open(in(long_enough)).has_value());
  ASSERT_FALSE(
      other.run("SELECT pg_terminate_backend($1, 10000)", {&process, 1}, in(long_enough), rows_));
  const auto failure = connection_->run("SELECT 1", {}, in(long_enough), rows_);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, Kind::lost);
  EXPECT_FALSE(connection_->is_open());
  EXPECT_EQ(connection_->run("SELECT 1", {}, in(long_enough), rows_)->kind, Kind::lost);
}

TEST(NoConnection, SaysWhoIsNotThere) {
  PostgresConnection nobody("postgresql://saca@/postgres?host=/nowhere");
  const auto failure = nobody.open(in(long_enough));
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, Kind::lost);
  EXPECT_THAT(failure->why, HasSubstr("/nowhere"));
  PostgresConnection unreadable("postgresql://me:secret@server?no=such");
  EXPECT_THAT(unreadable.open(in(long_enough))->why, testing::Not(HasSubstr("secret")));
}

}  // namespace
}  // namespace saca::memory::postgres_test
