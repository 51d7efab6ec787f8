#include "saca/thinking/memory/postgres_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "saca/base/core/contract.h"
#include "saca/thinking/memory/cases_for_test.h"
#include "saca/thinking/memory/postgres.h"
#include "tests/support/postgres_server.h"

namespace saca::memory::postgres_table_test {
namespace {

using testing::HasSubstr;

class Fleet : public testing::Test {
 protected:
  static void SetUpTestSuite() { server_ = test::PostgresServer::start(); }
  static void TearDownTestSuite() { server_.reset(); }
  void SetUp() override {
    if (!server_) {
      GTEST_SKIP() << "PostgreSQL is not installed";
    }
    shell("DROP TABLE IF EXISTS saca_cases, saca_bank");
  }

  static std::string shell(const std::string& sql) {
    PostgresConnection connection(server_->url());
    Rows rows;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    EXPECT_FALSE(connection.open(until).has_value());
    const auto failure = connection.run(sql, {}, until, rows);
    EXPECT_FALSE(failure.has_value()) << sql << ": " << failure->why;
    return !failure && rows.size() > 0 ? text_of(rows.cell(0, 0)) : "";
  }

  static std::string url() { return server_->url(); }
  static Store opened() { return Store::open(url()).value(); }
  static Error error_of_opening() {
    const auto store = Store::open(url());
    EXPECT_FALSE(store.has_value());
    return store.has_value() ? Error{} : store.error();
  }

  static std::unique_ptr<test::PostgresServer> server_;
};
std::unique_ptr<test::PostgresServer> Fleet::server_;

TEST_F(Fleet, KeepsCasesAsAFileDoes) {
  const std::string file = testing::TempDir() + "saca_fleet.db";
  std::filesystem::remove(file);
  Store here = Store::open(file).value();
  Store there = opened();
  std::vector<Case> cases;
  for (std::uint32_t i = 0; i < 12; ++i) {
    cases.push_back(example_case(i));
    cases.back().id = 3 * i + 1;
  }
  EXPECT_EQ(there.add_all(cases).value(), here.add_all(cases).value());
  EXPECT_EQ(there.add(example_case(20)).value(), here.add(example_case(20)).value());
  EXPECT_EQ(there.learn(example_case(4)).value().how, LearningResult::How::merged);
  EXPECT_EQ(here.learn(example_case(4)).value().how, LearningResult::How::merged);
  Case corrected = example_case(5);
  corrected.id = 16;
  corrected.review = "otherwise";
  EXPECT_EQ(there.change(16, becomes(corrected)), std::nullopt);
  EXPECT_EQ(here.change(16, becomes(corrected)), std::nullopt);
  std::vector<Case> gone{here.find(4).value().value(), here.find(7).value().value()};
  gone.push_back(gone.front());
  gone.back().id = 999;
  EXPECT_EQ(there.forget(gone).value(), 0U);
  EXPECT_EQ(here.forget(gone).value(), 0U);
  gone.front() = there.find(10).value().value();
  gone.front().review = "as it was";
  EXPECT_EQ(there.forget({gone.data(), 1}).value(), 1U) << "somebody has changed it";
  const auto source = [](const Case& one) { return one.source; };
  EXPECT_EQ(there.add_new(cases, source).value(), here.add_new(cases, source).value());
  EXPECT_EQ(there.digest().value(), here.digest().value());
  EXPECT_EQ(opened().digest().value(), here.digest().value());
  const Match match = there.recall(example_case(8).scene).value().value();
  EXPECT_EQ(match.found.id, here.recall(example_case(8).scene).value().value().found.id);
  expect_same(match.found, example_case(8));
  EXPECT_EQ(there.change(4, becomes(corrected)), std::nullopt) << "it is gone";
  corrected.count = 0;
  EXPECT_THROW((void)there.change(1, becomes(corrected)), ContractViolation);
  EXPECT_TRUE(there.add(example_case(1)).has_value()) << "no transaction is left open";
  std::filesystem::remove(file);
}

TEST_F(Fleet, ReadsMoreCasesThanItTakesAtOnce) {
  const std::vector<Case> many(2'500, example_case(9));
  Store store = opened();
  ASSERT_EQ(store.add_all(many).value().size(), many.size());
  EXPECT_EQ(opened().size(), many.size());
  EXPECT_EQ(opened().all().value().back().id, 2'500);
}

TEST_F(Fleet, GivesNoIdTwice) {
  Store store = opened();
  ASSERT_EQ(store.add(example_case(1)).value(), 1);
  ASSERT_EQ(store.add(example_case(2)).value(), 2);
  const Case last = store.find(2).value().value();
  ASSERT_EQ(store.forget({&last, 1}).value(), 0U);
  EXPECT_EQ(store.add(example_case(3)).value(), 3);
}

TEST_F(Fleet, AsksACopyWithoutTheServer) {
  ASSERT_TRUE(opened().add(example_case(3)).has_value());
  Store copy = Store::snapshot(url()).value();
  ASSERT_TRUE(opened().add(example_case(4)).has_value());
  EXPECT_EQ(copy.size(), 1U);
  expect_same(copy.recall(example_case(3).scene).value().value().found, example_case(3));
  EXPECT_EQ(copy.add(example_case(4)).error().code, Error::Code::unwritable);
}

TEST_F(Fleet, LooksWithoutMakingTables) {
  EXPECT_THAT(Store::open_existing(url()).error().message, HasSubstr("no such memory bank"));
  EXPECT_FALSE(Store::snapshot(url()).has_value());
  EXPECT_EQ(shell("SELECT to_regclass('saca_bank') IS NULL"), "t");
}

TEST_F(Fleet, TakesCasesFromFourProcessesThatMakeTheTablesToo) {
  constexpr int num_cases = 25;
  {
    Adder one(url(), num_cases);
    Adder two(url(), num_cases);
    Adder three(url(), num_cases);
    Adder four(url(), num_cases);
    for (const Adder* adder : {&one, &two, &three, &four}) {
      EXPECT_EQ(adder->wait(), 0);
    }
  }
  const std::vector<Case> cases = opened().all().value();
  ASSERT_EQ(cases.size(), 4U * num_cases);
  EXPECT_EQ(cases.back().id, 4 * num_cases) << "every id once, without a gap";
}

// Who has read all ids up to one must not miss a smaller one that is committed later.
TEST_F(Fleet, ShowsIdsInTheirOrder) {
  Store reader = opened();
  const Adder one(url(), 40);
  const Adder other(url(), 40);
  match::CaseId last = 0;
  while (last < 80) {
    ASSERT_TRUE(reader.recall(example_case(1).scene).has_value());
    last = reader.experience().last_id();
    ASSERT_EQ(reader.size(), static_cast<std::size_t>(last));
  }
  EXPECT_EQ(one.wait(), 0);
  EXPECT_EQ(other.wait(), 0);
}

TEST_F(Fleet, KeepsEveryReportedCaseWhenItsProcessIsKilled) {
  (void)opened();
  std::vector<match::CaseId> reported;
  for (int i = 0; i < 5; ++i) {
    const Adder adder(url(), 1'000'000);
    reported.push_back(adder.next().value());
    adder.kill_after(std::chrono::milliseconds(i));
    EXPECT_EQ(adder.wait(), -1);
    while (const auto id = adder.next()) {
      reported.push_back(*id);
    }
  }
  Store store = opened();
  for (const match::CaseId id : reported) {
    EXPECT_TRUE(store.find(id).value().has_value()) << id;
  }
}

// ---- A server that goes

TEST_F(Fleet, ConnectsAgainAndWritesNothingTwice) {
  Store store = opened();
  Store other = opened();
  ASSERT_EQ(store.add(example_case(1)).value(), 1);
  shell(
      "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity WHERE pid <> pg_backend_pid()"
      " AND backend_type = 'client backend'");
  EXPECT_EQ(store.add(example_case(2)).value(), 2);
  EXPECT_EQ(other.recall(example_case(2).scene).value().value().found.id, 2);
}

TEST_F(Fleet, OutlivesAServerThatLosesPower) {
  Store store = opened();
  ASSERT_EQ(store.add(example_case(1)).value(), 1);
  server_->kill();
  const auto begin = std::chrono::steady_clock::now();
  const auto asked = store.recall(example_case(1).scene);
  ASSERT_FALSE(asked.has_value());
  EXPECT_THAT(asked.error().message, HasSubstr("postgresql://saca@"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3))
      << "a decision waits for it";
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    server_->start_again();
  });
  const auto id = store.add(example_case(2));  // waits for it
  later.join();
  ASSERT_TRUE(id.has_value()) << id.error().message;
  EXPECT_EQ(id.value(), 2);
  EXPECT_EQ(opened().size(), 2U);
}

// Connections are cut at any time once the bank is open, also while a transaction ends: what was
// reported is there, and nothing twice.
TEST_F(Fleet, WritesEveryCaseOnceThoughConnectionsAreCut) {
  (void)opened();
  constexpr int num_cases = 150;
  const Adder adder(url(), num_cases);
  std::set<match::CaseId> reported{adder.next().value()};
  std::atomic<bool> is_done = false;
  std::thread cutter([&is_done] {
    while (!is_done) {
      shell(
          "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity"
          " WHERE pid <> pg_backend_pid() AND backend_type = 'client backend'");
      std::this_thread::sleep_for(std::chrono::milliseconds(7));
    }
  });
  while (const auto id = adder.next()) {
    reported.insert(*id);
  }
  is_done = true;
  cutter.join();
  EXPECT_EQ(adder.wait(), 0);
  EXPECT_EQ(reported.size(), std::size_t{num_cases});
  EXPECT_EQ(opened().size(), std::size_t{num_cases});
}

TEST_F(Fleet, WaitsForAWriterNoLongerThanItMay) {
  const auto table = open_postgres(url(), IfMissing::make).value();
  const auto other = open_postgres(url(), IfMissing::make).value();
  other->wait_at_most(std::chrono::milliseconds(100));
  const auto error = table->in_one_transaction([&]() -> std::optional<Error> {
    EXPECT_TRUE(table->insert(cells_of(example_case(1)), std::nullopt).has_value());
    const auto held = other->in_one_transaction([] { return std::optional<Error>(); });
    EXPECT_TRUE(held.has_value());
    return held ? std::optional(Error{held->code, "held"}) : std::nullopt;
  });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, Error::Code::too_late);
  EXPECT_EQ(other->find(1).value(), std::nullopt) << "it was taken back";
}

// ---- Tables that are not what they should be

TEST_F(Fleet, RefusesAnUnknownVersion) {
  (void)opened();
  shell("UPDATE saca_bank SET version = 4");
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("want version 3 of a memory bank or an older"));
  shell("DELETE FROM saca_bank");
  EXPECT_THAT(error_of_opening().message, HasSubstr("want one row in table saca_bank, got 0"));
}

TEST_F(Fleet, BringsAnOlderVersionToTheNewest) {
  ASSERT_TRUE(opened().add(example_case(2)).has_value());
  shell("ALTER TABLE saca_cases DROP COLUMN strength, DROP COLUMN details");
  shell("UPDATE saca_bank SET version = 1");
  Store store = opened();
  EXPECT_EQ(store.find(1).value().value().source, "case 2");
  EXPECT_EQ(store.find(1).value().value().count, 1);
  EXPECT_TRUE(store.add(example_case(3)).has_value());
  EXPECT_EQ(shell("SELECT version FROM saca_bank"), "3");
}

TEST_F(Fleet, RefusesTablesOfSomebodyElse) {
  (void)opened();
  shell("ALTER TABLE saca_cases DROP COLUMN harm");
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("want a memory bank's own tables"));
}

TEST_F(Fleet, NamesTheRowThatSomebodyEditedWrongly) {
  ASSERT_TRUE(opened().add(example_case(3)).has_value());
  for (const auto& [edit, message] : std::vector<std::pair<std::string, std::string>>{
           {"harm = 'NaN'", "harm: want a finite number >= 0"},
           {"harm = 0, best_policy = 8", "best_policy: want an integer from 0 to 7, got 8"},
           {"best_policy = 0, scene = '{}'", "scene: "},
           {"details = 'x'", "scene: "}}) {
    shell("UPDATE saca_cases SET " + edit);
    EXPECT_THAT(error_of_opening().message, HasSubstr("table cases, id 1: " + message));
  }
}

TEST_F(Fleet, RefusesTextThatNoServerTakes) {
  Case one = example_case(1);
  one.review = std::string("a\0b", 3);
  Store store = opened();
  const auto added = store.add(one);
  ASSERT_FALSE(added.has_value());
  EXPECT_THAT(added.error().message, HasSubstr("review: want text without the character NUL"));
  EXPECT_EQ(store.all().value().size(), 0U);
}

TEST_F(Fleet, AReplicaIsReadAndNotWritten) {
  ASSERT_TRUE(opened().add(example_case(1)).has_value());
  const auto replica = test::PostgresServer::replica_of(*server_);
  Store follower = Store::open(replica->url()).value();
  expect_same(follower.recall(example_case(1).scene).value().value().found, example_case(1));
  const auto refused = follower.add(example_case(2));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr("may only be read"));
  ASSERT_TRUE(opened().add(example_case(4)).has_value());
  for (int i = 0; i < 1'000 && follower.experience().last_id() < 2; ++i) {
    ASSERT_TRUE(follower.recall(example_case(4).scene).has_value());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(follower.recall(example_case(4).scene).value().value().found.id, 2);
}

TEST_F(Fleet, WhoMayOnlyReadReads) {
  ASSERT_TRUE(opened().add(example_case(1)).has_value());
  shell("DROP ROLE IF EXISTS guest");
  shell("CREATE ROLE guest LOGIN");
  shell("GRANT SELECT ON saca_cases, saca_bank TO guest");
  std::string as_guest = url();
  as_guest.replace(as_guest.find("saca@"), 5, "guest@");
  Store store = Store::open(as_guest).value();
  EXPECT_EQ(store.size(), 1U);
  const auto refused = store.add(example_case(2));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr("permission denied"));
}

}  // namespace
}  // namespace saca::memory::postgres_table_test
