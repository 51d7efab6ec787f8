#include "saca/thinking/memory/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/cases_for_test.h"

namespace saca::memory::store_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using world::Scene;

/// What somebody with the sqlite3 shell would do.
std::string shell(const fs::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  std::string answer;
  char* problem = nullptr;
  const auto append = [](void* text, int, char** values, char**) {
    *static_cast<std::string*>(text) += values[0] == nullptr ? "" : values[0];
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), append, &answer, &problem), SQLITE_OK)
      << sql << ": " << problem;
  sqlite3_free(problem);
  sqlite3_close(database);
  return answer;
}

class Memory : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    // A disk in memory where there is one, to be quick: what a killed process had written is not
    // lost with it on any disk.
    const fs::path quick = "/dev/shm";
    folder_ = (::access(quick.c_str(), W_OK) == 0 ? quick : fs::path(testing::TempDir())) /
              ("saca_memory_" + std::to_string(::getpid()) + "_" + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = folder_ / "bank.db";
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] Store opened() const { return Store::open(path_).value(); }
  [[nodiscard]] Error error_of_opening() const {
    const auto store = Store::open(path_);
    EXPECT_FALSE(store.has_value());
    return store.has_value() ? Error{} : store.error();
  }
  [[nodiscard]] std::string integrity() const { return shell(path_, "PRAGMA integrity_check"); }

  fs::path folder_;
  fs::path path_;
};

TEST(Gates, AreThoseOfThePaper) {
  EXPECT_EQ(gate(1.0), Gate::cache);
  EXPECT_EQ(gate(0.9001), Gate::cache);
  EXPECT_EQ(gate(0.9), Gate::check);
  EXPECT_EQ(gate(0.7001), Gate::check);
  EXPECT_EQ(gate(0.7), Gate::reason);
  EXPECT_EQ(gate(0.0), Gate::reason);
  EXPECT_EQ(gate(std::numeric_limits<double>::quiet_NaN()), Gate::reason);
}

TEST(Gates, LetNothingThroughAsItIsThatTrustedCasesAloneDoNotSupport) {
  const auto gate_at = [](double confidence, double trusted) {
    return gate(Match{.found = {}, .confidence = confidence, .trusted_confidence = trusted});
  };
  EXPECT_EQ(gate_at(0.95, 0.95), Gate::cache);
  EXPECT_EQ(gate_at(0.95, 0.91), Gate::cache);
  EXPECT_EQ(gate_at(0.95, 0.0), Gate::check);
  EXPECT_EQ(gate_at(0.8, 0.8), Gate::check);
  EXPECT_EQ(gate_at(0.5, 0.5), Gate::reason);
}

// ---- Coming back

TEST_F(Memory, IsEmptyAtFirst) {
  Store store = opened();
  EXPECT_TRUE(store.all().value().empty());
  EXPECT_EQ(store.find(1).value().has_value(), false);
  EXPECT_EQ(store.recall(match::crossing_truck()).value().has_value(), false);
}

TEST_F(Memory, GivesBackEveryCaseToTheLastBit) {
  std::vector<match::CaseId> ids;
  for (std::uint32_t i = 0; i < 10; ++i) {
    ids.push_back(opened().add(example_case(i)).value());  // opened anew each time
  }
  Store store = opened();
  EXPECT_EQ(store.size(), 10U);
  const std::vector<Case> cases = store.all().value();
  ASSERT_EQ(cases.size(), 10U);
  for (std::uint32_t i = 0; i < 10; ++i) {
    EXPECT_EQ(cases[i].id, ids[i]);
    expect_same(cases[i], example_case(i));
    expect_same(store.find(ids[i]).value().value(), example_case(i));
  }
}

TEST_F(Memory, KeepsAPlanWithoutATargetSpeed) {
  Case one = example_case(1);
  one.plan = {manoeuvre::PolicyId::aes_left, std::nullopt};
  Store store = opened();
  EXPECT_EQ(store.find(store.add(one).value()).value().value().plan, one.plan);
}

TEST_F(Memory, KeepsAStrength) {
  Case one = example_case(1);
  one.plan = {.policy = manoeuvre::PolicyId::aeb, .strength = 0.45};
  Store store = opened();
  const std::uint64_t before = store.digest().value();
  const match::CaseId id = store.add(one).value();
  EXPECT_EQ(store.find(id).value().value().plan, one.plan);
  const std::uint64_t with = store.digest().value();
  EXPECT_NE(with, before);
  shell(path_, "UPDATE cases SET strength = NULL");
  EXPECT_NE(store.digest().value(), with);
}

/// As an older program wrote it.
void make_version(int version, const fs::path& path) {
  shell(path, "ALTER TABLE cases DROP COLUMN details");
  if (version == 1) {
    shell(path, "ALTER TABLE cases DROP COLUMN strength");
  }
  shell(path, "PRAGMA user_version = " + std::to_string(version));
}

/// What version 2 knew of a case.
Case without_details(const Case& one) {
  return {.id = one.id,
          .scene = one.scene,
          .plan = one.plan,
          .best = one.best,
          .harm = one.harm,
          .best_harm = one.best_harm,
          .collision_loss = one.collision_loss,
          .review = one.review,
          .source = one.source};
}

TEST_F(Memory, ReadsAFileOfAnOlderVersionAndGoesOnWithIt) {
  for (const int version : {1, 2}) {
    fs::remove(path_);
    for (std::uint32_t i = 0; i < 4; ++i) {
      ASSERT_TRUE(opened().add(example_case(i)).has_value());
    }
    make_version(version, path_);
    {
      Store copy = Store::snapshot(path_).value();
      expect_same(copy.all().value().at(3), without_details(example_case(3)));
      EXPECT_FALSE(copy.add(example_case(1)).has_value());
    }
    EXPECT_EQ(shell(path_, "PRAGMA user_version"), std::to_string(version))
        << "a copy leaves the file alone";
    Store store = opened();
    Case gentle = example_case(4);
    gentle.plan = {.policy = manoeuvre::PolicyId::aeb, .strength = 0.3};
    ASSERT_TRUE(store.add(gentle).has_value());
    const std::vector<Case> cases = opened().all().value();
    ASSERT_EQ(cases.size(), 5U);
    for (std::uint32_t i = 0; i < 4; ++i) {
      expect_same(cases[i], without_details(example_case(i)));
    }
    expect_same(cases[4], gentle);
    EXPECT_EQ(integrity(), "ok");
  }
}

TEST_F(Memory, IsReadableInTheShell) {
  ASSERT_TRUE(opened().add(example_case(3)).has_value());
  EXPECT_EQ(shell(path_, "SELECT policy FROM cases"), "4");
  EXPECT_EQ(shell(path_, "SELECT scene ->> '$.schema' FROM cases"), "saca.scene/1");
  EXPECT_EQ(shell(path_, "SELECT json_array_length(scene, '$.actors') FROM cases"), "3");
}

TEST_F(Memory, FindsTheNearestLikeALinearScan) {
  Store store = opened();
  for (std::uint32_t i = 0; i < 30; ++i) {
    ASSERT_TRUE(store.add(example_case(i)).has_value());
  }
  const std::vector<Case> cases = store.all().value();
  for (std::uint32_t i = 100; i < 120; ++i) {
    const Scene scene = example_case(i).scene;
    const Case* best = &cases.front();
    for (const Case& one : cases) {
      best =
          match::similarity(one.scene, scene) > match::similarity(best->scene, scene) ? &one : best;
    }
    const Match match = store.recall(scene).value().value();
    EXPECT_EQ(match.found.id, best->id);
    EXPECT_NEAR(match.similarity, match::similarity(best->scene, scene), 1e-6);
    expect_same(match.found, *best);
  }
  EXPECT_EQ(store.recall(cases[7].scene).value().value().similarity, 1.0);
}

// ---- Changing, and taking over

TEST_F(Memory, WritesACaseAgain) {
  Store store = opened();
  const match::CaseId id = store.add(example_case(1)).value();
  ASSERT_TRUE(store.add(example_case(2)).has_value());
  Case changed = example_case(1);
  changed.id = id;
  changed.trust = Trust::quarantined;
  changed.lessons.emplace_back("a truck was hidden");
  changed.plan = {manoeuvre::PolicyId::no_intervention};
  EXPECT_FALSE(store.change(id, becomes(changed)).has_value());
  expect_same(opened().find(id).value().value(), changed);
  expect_same(opened().find(id + 1).value().value(), example_case(2));
  EXPECT_FALSE(store.change(99, becomes(changed)).has_value()) << "somebody has deleted it";
  EXPECT_EQ(opened().size(), 2U);
  const auto spoils_and_leaves = [](Case& one) {
    one.harm = 7.0;
    return false;
  };
  EXPECT_FALSE(store.change(id, spoils_and_leaves).has_value());
  expect_same(opened().find(id).value().value(), changed);
}

// Each adds to what the other has written meanwhile, and nothing is lost.
TEST_F(Memory, ChangesACaseAsItIsThen) {
  Store one = opened();
  Store other = opened();
  const match::CaseId id = one.add(example_case(1)).value();
  ASSERT_FALSE(other.catch_up().has_value());
  const auto counts = [](Case& known) {
    ++known.count;
    return true;
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(one.change(id, counts).has_value());
    EXPECT_FALSE(other.change(id, counts).has_value());
  }
  EXPECT_EQ(opened().find(id).value().value().count, example_case(1).count + 6);
}

TEST_F(Memory, IsNotLeftInTheMiddleOfAChangeThatThrows) {
  Store store = opened();
  const match::CaseId id = store.add(example_case(1)).value();
  const auto breaks_a_rule = [](Case& one) {
    one.count = 0;
    return true;
  };
  EXPECT_THROW((void)store.change(id, breaks_a_rule), ContractViolation);
  expect_same(opened().find(id).value().value(), [&] {
    Case same = example_case(1);
    same.id = id;
    return same;
  }());
  EXPECT_TRUE(store.add(example_case(2)).has_value()) << "no transaction is left open";
}

/// In this scene one policy harms nobody, and all others do.
Case best_is(manoeuvre::PolicyId policy, double speed) {
  Case one;
  one.scene = match::empty_road();
  one.scene.ego.v_B.x = speed;
  one.best = policy;
  one.happened.emplace();
  for (std::optional<double>& harm : *one.happened) {
    harm = 0.25;
  }
  one.happened->at(manoeuvre::index(policy)) = 0.0;
  return one;
}

TEST_F(Memory, MergesWhatItMeetsAgain) {
  Store store = opened();
  const LearningResult first = store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value();
  EXPECT_EQ(first.how, LearningResult::How::added);
  EXPECT_EQ(store.learn(best_is(manoeuvre::PolicyId::aeb, 16.0)).value().how,
            LearningResult::How::added);
  Case again = best_is(manoeuvre::PolicyId::aeb, 14.1);
  again.harm = 0.5;
  const LearningResult second = store.learn(again).value();
  EXPECT_EQ(second.how, LearningResult::How::merged);
  EXPECT_EQ(second.id, first.id);
  const Case kept = opened().find(first.id).value().value();
  EXPECT_EQ(kept.count, 2);
  EXPECT_EQ(kept.harm, 0.25);
  EXPECT_EQ(kept.worst_harm, 0.5);
  EXPECT_EQ(opened().size(), 2U);
}

// Nobody's encounter is lost, though all are the same one.
TEST_F(Memory, MergesForTwoProcessesAtOnce) {
  constexpr int times = 40;
  ASSERT_TRUE(opened().learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).has_value());
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  bool learnt = true;
  {
    Store store = opened();
    for (int i = 0; i < times; ++i) {
      learnt = learnt && store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).has_value();
    }
  }
  if (child == 0) {
    ::_exit(learnt ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(learnt && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(opened().find(1).value().value().count, 2 * times + 1);
  EXPECT_EQ(opened().size(), 1U);
}

TEST_F(Memory, KeepsWhatContradictsAndTrustsNeither) {
  Store store = opened();
  const match::CaseId old = store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value().id;
  const LearningResult other = store.learn(best_is(manoeuvre::PolicyId::aes_left, 14.1)).value();
  EXPECT_EQ(other.how, LearningResult::How::contradicted);
  EXPECT_EQ(other.other, old);
  for (const match::CaseId id : {old, other.id}) {
    EXPECT_EQ(opened().find(id).value().value().trust, Trust::unchecked);
  }
  const Match match = store.recall(best_is(manoeuvre::PolicyId::aeb, 14.0).scene).value().value();
  EXPECT_EQ(gate(match), Gate::reason) << "they disagree: " << match.confidence;
  EXPECT_EQ(match.trusted_confidence, 0.0) << "also where the bank has been open all the time";
}

// The nearest is not asked alone: where another is the same encounter and agrees, they become one.
TEST_F(Memory, MergesIntoTheOneThatAgrees) {
  Store store = opened();
  const match::CaseId aeb = store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value().id;
  const match::CaseId left = store.learn(best_is(manoeuvre::PolicyId::aes_left, 14.1)).value().id;
  for (int i = 0; i < 3; ++i) {
    const LearningResult again = store.learn(best_is(manoeuvre::PolicyId::aes_left, 14.0)).value();
    EXPECT_EQ(again.how, LearningResult::How::merged);
    EXPECT_EQ(again.id, left) << "case " << aeb << " is nearer, and contradicts it";
  }
  EXPECT_EQ(opened().size(), 2U);
}

// Somebody has quarantined what it would be merged into, and it must not vanish with it.
TEST_F(Memory, MergesIntoNobodyWhoIsQuarantined) {
  Store store = opened();
  Case wrong = best_is(manoeuvre::PolicyId::aeb, 14.0);
  wrong.id = store.learn(wrong).value().id;
  Store other = opened();
  wrong.trust = Trust::quarantined;
  ASSERT_FALSE(other.change(wrong.id, becomes(wrong)).has_value());
  const LearningResult again = store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value();
  EXPECT_EQ(again.how, LearningResult::How::added);
  EXPECT_EQ(opened().recall(wrong.scene).value().value().found.id, again.id);
}

TEST_F(Memory, MergesNoEncountersOfDifferentCars) {
  const auto made_with = [](const char* car) {
    return std::vector<MadeWith>{{"car", "car", car}, {"harm", "harm", "h"}};
  };
  Store store = opened();
  Case one = best_is(manoeuvre::PolicyId::aeb, 14.0);
  one.made_with = made_with("a");
  const match::CaseId first = store.learn(one).value().id;
  one.made_with = made_with("b");
  EXPECT_EQ(store.learn(one).value().how, LearningResult::How::added);
  EXPECT_EQ(store.learn(one).value().id, first + 1);
  one.made_with.clear();
  EXPECT_EQ(store.learn(one).value().how, LearningResult::How::merged) << "nobody knows which";
}

// What another car learnt is asked, but not believed.
TEST_F(Memory, IsTrustedByTheCarThatItWasWorkedOutWith) {
  const std::vector<MadeWith> car{{"car", "car", "a"}, {"harm", "harm", "h"}};
  const std::vector<MadeWith> other{{"car", "car", "b"}, {"harm", "harm", "h"}};
  Case one = best_is(manoeuvre::PolicyId::aeb, 14.0);
  one.made_with = car;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(opened().add(one).has_value());
  }
  const auto trusted_by = [&](const std::vector<MadeWith>& asking) {
    const Match open = Store::open(path_, asking).value().recall(one.scene).value().value();
    const Match copy = Store::snapshot(path_, asking).value().recall(one.scene).value().value();
    EXPECT_EQ(open.confidence, copy.confidence);
    EXPECT_EQ(open.trusted_confidence, copy.trusted_confidence);
    EXPECT_GT(open.confidence, 0.9);
    return open.trusted_confidence;
  };
  EXPECT_GT(trusted_by(car), 0.9);
  EXPECT_EQ(trusted_by(other), 0.0);
  EXPECT_GT(trusted_by({}), 0.9) << "no matter which";
}

TEST_F(Memory, BeginsWithCasesOnlyWhereThereAreNone) {
  std::vector<Case> cases{example_case(1), example_case(2)};
  cases[0].id = 5;
  cases[1].id = 9;
  Store store = opened();
  EXPECT_FALSE(store.begin_with(cases).has_value());
  EXPECT_FALSE(opened().begin_with(cases).has_value()) << "another process was faster";
  EXPECT_EQ(opened().size(), 2U);
  EXPECT_TRUE(opened().find(9).value().has_value());
}

TEST_F(Memory, GivesNewIdsWhereTheirOwnLeaveNoRoom) {
  Case one = example_case(1);
  one.id = std::numeric_limits<match::CaseId>::max();
  Store store = opened();
  EXPECT_EQ(store.add_all({&one, 1}).value(), std::vector<match::CaseId>{1});
  EXPECT_TRUE(store.add(example_case(2)).has_value());
}

TEST_F(Memory, PassesOverWhoIsQuarantined) {
  Store asked = opened();
  Store other = opened();
  Case best = example_case(3);
  best.id = other.add(best).value();
  const match::CaseId second = other.add(example_case(4)).value();
  EXPECT_EQ(asked.recall(best.scene).value().value().found.id, best.id);
  best.trust = Trust::quarantined;
  EXPECT_FALSE(other.change(best.id, becomes(best)).has_value());
  EXPECT_EQ(asked.recall(best.scene).value().value().found.id, second) << "another's change";
  EXPECT_EQ(opened().recall(best.scene).value().value().found.id, second);
  Case last = example_case(4);
  last.id = second;
  last.trust = Trust::quarantined;
  EXPECT_FALSE(other.change(last.id, becomes(last)).has_value());
  EXPECT_FALSE(asked.recall(best.scene).value().has_value());
}

TEST_F(Memory, ForgetsWhatItIsToldTo) {
  Store store = opened();
  std::mt19937 rng(11);
  std::vector<Case> cases;
  for (std::uint32_t i = 0; i < 5; ++i) {
    cases.push_back(example_case(i));
    cases.back().scene = match::random_scene(rng, 2);
  }
  const std::vector<match::CaseId> ids = store.add_all(cases).value();
  const std::vector<Case> read = store.all().value();
  Case gone = read[0];
  gone.id = 777;
  EXPECT_EQ(store.forget(std::vector{read[1], read[3], gone}).value(), 0U);
  EXPECT_EQ(store.size(), 3U);
  EXPECT_FALSE(store.find(ids[1]).value());
  EXPECT_TRUE(store.find(ids[2]).value());
  const auto match = store.recall(cases[3].scene).value();
  ASSERT_TRUE(match);
  EXPECT_NE(match->found.id, ids[3]);
  EXPECT_EQ(store.forget({}).value(), 0U);
  EXPECT_EQ(opened().size(), 3U);
  Store fixed = Store::snapshot(path_).value();
  const auto refused = fixed.forget({read.data(), 1});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_EQ(fixed.size(), 3U);
}

// Who decides what may go decides by what was read; what somebody has learnt since stays.
TEST_F(Memory, ForgetsNothingThatSomebodyHasLearntOfSince) {
  Store store = opened();
  const match::CaseId first = store.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value().id;
  const match::CaseId second = store.learn(best_is(manoeuvre::PolicyId::aeb, 20.0)).value().id;
  const std::vector<Case> read = store.all().value();
  Store other = opened();
  ASSERT_EQ(other.learn(best_is(manoeuvre::PolicyId::aeb, 14.0)).value().id, first);
  EXPECT_EQ(store.forget(read).value(), 1U);
  EXPECT_EQ(opened().find(first).value().value().count, 2);
  EXPECT_FALSE(opened().find(second).value().has_value());
  EXPECT_EQ(store.size(), 1U);
  EXPECT_EQ(store.forget(store.all().value()).value(), 0U) << "as it is now it was read";
  EXPECT_EQ(opened().size(), 0U);
}

TEST_F(Memory, AddsOnlyWhatItHasNot) {
  const auto source = [](const Case& one) { return one.source; };
  std::vector<Case> cases{example_case(1), example_case(2), example_case(1)};
  cases[0].id = 30;
  cases[1].id = 40;
  cases[2].id = 50;
  Store store = opened();
  EXPECT_THAT(store.add_new(cases, source).value(), testing::ElementsAre(30, 40))
      << "an empty bank takes their own ids";
  cases.push_back(example_case(3));
  EXPECT_THAT(store.add_new(cases, source).value(), testing::ElementsAre(41));
  EXPECT_TRUE(store.add_new(cases, source).value().empty());
  expect_same(opened().find(41).value().value(), example_case(3));
  cases.back().harm = -1.0;
  EXPECT_THROW((void)store.add_new(cases, source), ContractViolation);
  EXPECT_EQ(opened().size(), 3U);
}

TEST_F(Memory, AddsWhatIsNewOnceForTwoProcessesAtOnce) {
  std::vector<Case> cases;
  for (std::uint32_t i = 0; i < 50; ++i) {
    cases.push_back(example_case(i));
  }
  ASSERT_TRUE(opened().add_all({}).has_value());  // the file is there
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  const bool added = [&] {
    Store store = opened();
    return store.add_new(cases, [](const Case& one) { return one.source; }).has_value();
  }();
  if (child == 0) {
    ::_exit(added ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(added && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(opened().size(), cases.size());
}

TEST_F(Memory, TakesManyCasesOrNone) {
  std::vector<Case> cases;
  for (std::uint32_t i = 1; i <= 5; ++i) {
    cases.push_back(example_case(i));
    cases.back().id = match::CaseId{10} * i;
  }
  Store store = opened();
  EXPECT_THAT(store.add_all(cases).value(), testing::ElementsAre(10, 20, 30, 40, 50));
  const auto again = store.add_all(cases).value();
  EXPECT_THAT(again, testing::ElementsAre(51, 52, 53, 54, 55)) << "ids are never used twice";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    expect_same(opened().find(again[i]).value().value(), cases[i]);
  }
  cases.back().harm = -1.0;
  EXPECT_THROW((void)store.add_all(cases), ContractViolation);
  EXPECT_EQ(opened().size(), 10U);
  EXPECT_TRUE(store.add_all({}).value().empty());
}

TEST_F(Memory, TakesNoneWhereTheDiskTakesNotAll) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(1)).has_value());
  std::vector<Case> many(500, example_case(8));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 200'000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto added = store.add_all(many);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error().code, Error::Code::unwritable);
  EXPECT_EQ(store.all().value().size(), 1U);
  EXPECT_EQ(opened().size(), 1U);
  EXPECT_EQ(integrity(), "ok");
}

TEST_F(Memory, RefusesWhatIsNoCase) {
  Store store = opened();
  Case bad = example_case(1);
  bad.harm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)store.add(bad), ContractViolation);
  bad = example_case(1);
  bad.scene.grip = 0.0;
  EXPECT_THROW((void)store.add(bad), ContractViolation);
  EXPECT_THROW((void)store.recall(bad.scene), ContractViolation);
  bad = example_case(1);
  bad.plan.policy = manoeuvre::PolicyId::aeb;
  EXPECT_THROW((void)store.add(bad), ContractViolation);
  EXPECT_TRUE(store.all().value().empty());
}

// ---- Files that are not what they should be

TEST_F(Memory, SaysWhatItCannotOpen) {
  path_ = folder_ / "missing" / "bank.db";
  EXPECT_EQ(error_of_opening().code, Error::Code::unreadable);
  EXPECT_THAT(error_of_opening().message, HasSubstr("missing/bank.db: cannot be read"));
  path_ = folder_;
  EXPECT_EQ(error_of_opening().code, Error::Code::unreadable);
  path_ = "";
  EXPECT_EQ(error_of_opening().code, Error::Code::unreadable);
  path_ = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THAT(error_of_opening().message, HasSubstr("pipe: cannot be read: is no file"));
  path_ = "/dev/null";
  EXPECT_EQ(error_of_opening().code, Error::Code::unreadable);
}

TEST_F(Memory, RefusesAFileThatIsNoDatabase) {
  ASSERT_EQ(write_file(path_, std::string(5000, 'x')), std::nullopt);
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("bank.db: want a memory bank"));
  EXPECT_EQ(read_file(path_).value(), std::string(5000, 'x'));  // and leaves it alone
}

TEST_F(Memory, RefusesADatabaseOfAnotherProgram) {
  shell(path_, "CREATE TABLE cases (id INTEGER PRIMARY KEY); PRAGMA user_version = 1");
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("another program"));
}

TEST_F(Memory, RefusesAnUnknownVersion) {
  ASSERT_TRUE(opened().add(example_case(1)).has_value());
  shell(path_, "PRAGMA user_version = 4");
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message,
              HasSubstr("want version 3 of a memory bank or an older one, got version 4"));
}

TEST_F(Memory, RefusesAFileThatIsDamagedOrCutShort) {
  {
    Store store = opened();
    for (std::uint32_t i = 0; i < 20; ++i) {
      ASSERT_TRUE(store.add(example_case(i)).has_value());
    }
  }
  const std::string good = read_file(path_).value();
  const std::size_t page = 4096;
  ASSERT_GT(good.size(), 4 * page);
  std::string bad = good;
  bad.replace(2 * page, page, std::string(page, '\xff'));
  ASSERT_EQ(write_file(path_, bad), std::nullopt);
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("bank.db"));
  ASSERT_EQ(write_file(path_, good.substr(0, good.size() / 2)), std::nullopt);
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
}

// Fuzz: whatever bytes are wrong, opening ends with a store or an error.
TEST_F(Memory, SurvivesAnyFlippedBytes) {
  ASSERT_TRUE(opened().add(example_case(8)).has_value());
  const std::string good = read_file(path_).value();
  std::mt19937 rng(1);
  int num_refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    for (int flip = 0; flip < 8; ++flip) {
      const std::size_t where = flip % 2 == 0 ? rng() % 200 : rng() % bad.size();
      bad[where] = static_cast<char>(rng());
    }
    ASSERT_EQ(write_file(path_, bad), std::nullopt);
    auto store = Store::open(path_);
    if (store.has_value()) {
      (void)std::move(store).value().all();
    } else {
      EXPECT_THAT(store.error().message, HasSubstr("bank.db"));
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 30);
}

TEST_F(Memory, NamesTheRowThatSomebodyEditedWrongly) {
  const std::vector<std::pair<const char*, const char*>> edits{
      {"policy = 8", "policy: want an integer from 0 to 7, got 8"},
      {"policy = -1", "policy: want"},
      {"strength = 0.5", "strength: only policy 0 has one, of at most 1"},
      {"policy = 0, target_speed_mps = NULL, strength = 1.5", "strength: only policy 0 has one"},
      {"policy = 0", "target_speed_mps: only policies 3 and 4 have one"},
      {"best_policy = 99", "best_policy: want"},
      {"target_speed_mps = -1.0", "target_speed_mps: want a finite number >= 0"},
      {"harm = 9e999", "harm: want a finite number >= 0"},
      {"collision_loss = -0.5", "collision_loss: want"},
      {"scene = 'once upon a time'", "scene: want JSON, got `once upon a time`"},
      {"scene = printf('%.*c', 500000, '[')", "scene: want JSON of at most 32 levels"},
      {"scene = json_remove(scene, '$.grip')", "scene: grip: is missing"},
      {"scene = json_set(scene, '$.grip', null)", "scene: grip: want a finite number, got null"},
      {"scene = replace(scene, 'saca.scene/1', 'saca.scene/7')", "scene: schema: want"},
      {"scene = json_set(scene, '$.actors[0].kind', 'tank')", "scene: actors[0].kind: want car"},
      {"scene = json_set(scene, '$.ego.mass_kg', -5)", "scene: scene: want that"},
      {"scene = json_set(scene, '$.x', 1)", "scene: x: is not known"},
      {"details = ''", "details: want JSON"},
      {"details = '{\"trust\": \"blind\"}'", "details: trust: want trusted, unchecked or"},
      {"details = '{\"count\": 0}'", "id 2: count: want a whole number >= 1"},
      {"details = '{\"told\": [1, 2]}'", "details: told: want one entry per policy, 8, got 2"},
      {"details = '{\"happened\": [0, 0, 0, 0, 0, 0, 0, -1]}'", "id 2: happened: want 8 numbers"},
      {"details = '{\"risks\": [0.5]}'", "id 2: risks: want one per actor"},
      {"details = '{\"more\": 1}'", "details: more: is not known"},
  };
  for (const auto& [edit, message] : edits) {
    fs::remove(path_);
    {
      Store store = opened();
      ASSERT_TRUE(store.add(example_case(3)).has_value());
      ASSERT_TRUE(store.add(example_case(4)).has_value());
    }
    shell(path_, "UPDATE cases SET " + std::string(edit) + " WHERE id = 2");
    EXPECT_EQ(error_of_opening().code, Error::Code::malformed) << edit;
    EXPECT_THAT(error_of_opening().message, HasSubstr("bank.db: table cases, id 2: ")) << edit;
    EXPECT_THAT(error_of_opening().message, HasSubstr(message)) << edit;
  }
}

// What SQL can hide in a file: a view that never ends, a trigger that takes back what was written,
// columns and indices that compute.
TEST_F(Memory, RefusesWhateverItsOwnStatementsDoNotMake) {
  const std::string endless =
      "WITH RECURSIVE r(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM r) SELECT id, 0 AS policy,"
      " NULL AS target_speed_mps, 0 AS best_policy, 0.0 AS harm, 0.0 AS best_harm,"
      " 0.0 AS collision_loss, '' AS review, '' AS source, '{}' AS scene, NULL AS strength, '{}' "
      "AS details FROM r";
  const std::vector<std::pair<std::string, const char*>> hidden{
      {"DROP TABLE cases; CREATE VIEW cases AS " + endless, "got the view cases: CREATE VIEW"},
      {"CREATE VIEW more AS " + endless, "got the view more"},
      {"CREATE TRIGGER t AFTER INSERT ON cases BEGIN DELETE FROM cases; END",
       "got the trigger t: CREATE TRIGGER"},
      {"CREATE INDEX i ON cases (length(scene))", "got the index i"},
      {"CREATE TABLE other (a)", "got the table other"},
      {"CREATE VIRTUAL TABLE other USING rtree(id, a, b)", "got the table other"},
      {"ALTER TABLE cases ADD COLUMN more TEXT", "got the table cases"},
      {"ALTER TABLE cases ADD COLUMN more TEXT AS (hex(zeroblob(100000000)))",
       "got the table cases"},
      {"DROP TABLE cases", "lacks CREATE TABLE cases"},
  };
  for (const auto& [sql, words] : hidden) {
    fs::remove(path_);
    ASSERT_TRUE(opened().add(example_case(1)).has_value());
    shell(path_, sql);
    EXPECT_EQ(error_of_opening().code, Error::Code::malformed) << sql;
    EXPECT_THAT(error_of_opening().message, HasSubstr(words));
    EXPECT_LT(error_of_opening().message.size(), 500U);
    EXPECT_FALSE(Store::snapshot(path_).has_value()) << sql;
  }
}

TEST_F(Memory, ATriggerThatSomebodyAddsMeanwhileTakesNoCaseBack) {
  Store store = opened();
  shell(path_, "CREATE TRIGGER t AFTER INSERT ON cases BEGIN DELETE FROM cases; END");
  const auto id = store.add(example_case(1));
  ASSERT_TRUE(id.has_value());
  EXPECT_TRUE(store.find(id.value()).value().has_value());
  EXPECT_EQ(shell(path_, "SELECT count(*) FROM cases"), "1");
}

TEST_F(Memory, RefusesATableThatLacksAColumn) {
  ASSERT_TRUE(opened().add(example_case(1)).has_value());
  shell(path_, "ALTER TABLE cases DROP COLUMN harm");
  EXPECT_EQ(error_of_opening().code, Error::Code::malformed);
  EXPECT_THAT(error_of_opening().message, HasSubstr("want a memory bank's own tables"));
}

// ---- A copy to ask

TEST_F(Memory, ASnapshotStaysAsItWas) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(3)).has_value());
  Store snapshot = Store::snapshot(path_).value();
  const auto before = snapshot.digest().value();
  EXPECT_EQ(before, store.digest().value());
  ASSERT_TRUE(store.add(example_case(4)).has_value());
  expect_same(snapshot.recall(example_case(4).scene).value().value().found, example_case(3));
  EXPECT_EQ(snapshot.all().value().size(), 1U);
  EXPECT_EQ(snapshot.digest().value(), before);
  EXPECT_NE(store.digest().value(), before);
  fs::remove(path_);
  EXPECT_TRUE(snapshot.find(1).value().has_value());
}

TEST_F(Memory, ASnapshotLearnsNothing) {
  ASSERT_TRUE(opened().add(example_case(3)).has_value());
  Store snapshot = Store::snapshot(path_).value();
  const auto added = snapshot.add(example_case(4));
  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error().code, Error::Code::unwritable);
  EXPECT_EQ(opened().size(), 1U);
}

TEST_F(Memory, ASnapshotIsOfAMemoryThatIsThere) {
  EXPECT_THAT(Store::snapshot(path_).error().message, HasSubstr("there is no such memory bank"));
  EXPECT_FALSE(fs::exists(path_));
  ASSERT_EQ(write_file(path_, ""), std::nullopt);
  EXPECT_THAT(Store::snapshot(path_).error().message, HasSubstr("want a memory bank"));
  EXPECT_EQ(fs::file_size(path_), 0U);
  ASSERT_EQ(write_file(path_, std::string(5000, 'x')), std::nullopt);
  EXPECT_EQ(Store::snapshot(path_).error().code, Error::Code::malformed);
}

TEST_F(Memory, TheDigestTellsEveryColumnApart) {
  ASSERT_TRUE(opened().add(example_case(3)).has_value());
  std::uint64_t before = opened().digest().value();
  for (const char* const edit : {"policy = 3", "target_speed_mps = 2.5", "best_policy = 2",
                                 "harm = 0.25", "best_harm = 0.125", "collision_loss = 2.0",
                                 "review = 'r'", "source = 's'", "id = 7", "details = '{}'"}) {
    shell(path_, "UPDATE cases SET " + std::string(edit));
    const std::uint64_t after = opened().digest().value();
    EXPECT_NE(after, before) << edit;
    before = after;
  }
}

// ---- Nowhere to write

/// Not root for a while: root may write to everything.
class AsNobody {
 public:
  AsNobody() {
    constexpr uid_t nobody = 65534;
    dropped_ = ::geteuid() == 0 && ::seteuid(nobody) == 0;
  }
  ~AsNobody() {
    if (dropped_) {
      EXPECT_EQ(::seteuid(0), 0);
    }
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool dropped_ = false;
};

TEST_F(Memory, OpensAReadOnlyFileForReading) {
  ASSERT_TRUE(opened().add(example_case(5)).has_value());
  fs::permissions(path_, fs::perms(0444));
  fs::permissions(folder_, fs::perms(0555));
  {
    const AsNobody nobody;
    Store store = opened();
    expect_same(store.recall(example_case(5).scene).value().value().found, example_case(5));
    const auto added = store.add(example_case(6));
    ASSERT_FALSE(added.has_value());
    EXPECT_EQ(added.error().code, Error::Code::unwritable);
    EXPECT_THAT(added.error().message, HasSubstr("bank.db: cannot be written"));
    EXPECT_THAT(added.error().message, HasSubstr("readonly"));
    EXPECT_EQ(store.all().value().size(), 1U);
  }
  fs::permissions(folder_, fs::perms(0755));
}

TEST_F(Memory, ReadsAFileOfAnOlderVersionThatMayNotBeWritten) {
  ASSERT_TRUE(opened().add(example_case(5)).has_value());
  make_version(1, path_);
  fs::permissions(path_, fs::perms(0444));
  fs::permissions(folder_, fs::perms(0555));
  {
    const AsNobody nobody;
    Store store = opened();
    expect_same(store.recall(example_case(5).scene).value().value().found,
                without_details(example_case(5)));
    const auto added = store.add(example_case(6));
    ASSERT_FALSE(added.has_value());
    EXPECT_EQ(added.error().code, Error::Code::unwritable);
    EXPECT_EQ(store.all().value().size(), 1U);
  }
  fs::permissions(folder_, fs::perms(0755));
}

/// Adds until that fails; what was added before must be there, then and afterwards.
void fill(const fs::path& path, const std::function<void()>& make_room) {
  Store store = Store::open(path).value();
  match::CaseId last = 0;
  std::optional<Error> error;
  for (std::uint32_t i = 0; i < 1000 && !error; ++i) {
    const auto added = store.add(example_case(i));
    if (added.has_value()) {
      last = added.value();
    } else {
      error = added.error();
    }
  }
  ASSERT_TRUE(error.has_value());
  ASSERT_GT(last, 3);
  EXPECT_EQ(error->code, Error::Code::unwritable);
  EXPECT_THAT(error->message, HasSubstr("bank.db: cannot be written"));
  EXPECT_EQ(static_cast<match::CaseId>(store.all().value().size()), last);
  make_room();
  EXPECT_EQ(store.add(example_case(1)).value(), last + 1);
  EXPECT_EQ(static_cast<match::CaseId>(Store::open(path).value().all().value().size()), last + 1);
  EXPECT_EQ(shell(path, "PRAGMA integrity_check"), "ok");
}

TEST_F(Memory, LosesNothingWhenTheFileMayNotGrow) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{.rlim_cur = 60'000, .rlim_max = before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto make_room = [&] { ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0); };
  fill(path_, make_room);
  make_room();
  std::signal(SIGXFSZ, handler);
}

TEST_F(Memory, LosesNothingOnAFullDisk) {
  const fs::path disk = folder_ / "disk";
  fs::create_directories(disk);
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=128k") != 0) {
    GTEST_SKIP() << "a small disk needs the right to mount";
  }
  const auto make_room = [&] {
    EXPECT_EQ(::mount("none", disk.c_str(), "tmpfs", MS_REMOUNT, "size=1m"), 0);
  };
  fill(disk / "bank.db", make_room);
  EXPECT_EQ(::umount(disk.c_str()), 0);
}

// ---- Several processes

TEST_F(Memory, SeesWhatAnotherProcessAdds) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(50)).has_value());
  ASSERT_EQ(store.recall(example_case(4).scene).value().value().found.id, 1);
  Adder other(path_, 5);
  EXPECT_EQ(other.wait(), 0);
  const Match match = store.recall(example_case(4).scene).value().value();
  EXPECT_EQ(match.similarity, 1.0);
  expect_same(match.found, example_case(4));
}

TEST_F(Memory, ForgetsWhatAnotherProcessDeletes) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(1)).has_value());
  ASSERT_TRUE(store.add(example_case(2)).has_value());
  ASSERT_EQ(store.recall(example_case(1).scene).value().value().found.id, 1);
  shell(path_, "DELETE FROM cases WHERE id = 1");
  EXPECT_EQ(store.recall(example_case(1).scene).value().value().found.id, 2);
  shell(path_, "DELETE FROM cases");
  EXPECT_FALSE(store.recall(example_case(1).scene).value().has_value());
}

// Thousands of rows read anew would keep a decision waiting: only who is gone is left out.
TEST_F(Memory, LeavesOutWhoIsDeletedWithoutReadingAllAnew) {
  Store store = opened();
  const Case one = best_is(manoeuvre::PolicyId::aeb, 14.0);
  const Case far = best_is(manoeuvre::PolicyId::aes_left, 25.0);
  ASSERT_TRUE(store.add_all(std::vector{one, one, far}).has_value());
  ASSERT_EQ(store.recall(one.scene).value().value().found.id, 1);
  shell(path_, "DELETE FROM cases WHERE id = 1");
  shell(path_, "UPDATE cases SET details = 'no JSON' WHERE id = 3");  // whoever reads it fails
  EXPECT_EQ(store.recall(one.scene).value().value().found.id, 2);
  shell(path_, "DELETE FROM cases WHERE id = 3");
  EXPECT_EQ(store.size(), 3U);
  EXPECT_EQ(store.learn(one).value().id, 2);
  EXPECT_EQ(store.size(), 1U) << "to learn there is time to read all anew";
}

// What is served is as it is now, and so is how far it may be relied on.
TEST_F(Memory, ServesNobodyByWhatWasReadOfHimBefore) {
  Store asked = opened();
  Store other = opened();
  const Case one = best_is(manoeuvre::PolicyId::aeb, 14.0);
  const match::CaseId id = other.add(one).value();
  const Match before = asked.recall(one.scene).value().value();
  EXPECT_EQ(before.trusted_confidence, before.confidence);
  const auto doubt = [](Case& known) {
    known.trust = Trust::unchecked;
    return true;
  };
  ASSERT_FALSE(other.change(id, doubt).has_value());
  EXPECT_EQ(asked.recall(one.scene).value().value().trusted_confidence, 0.0);
  const auto turn = [](Case& known) {
    known.happened = best_is(manoeuvre::PolicyId::aes_left, 14.0).happened;
    return true;
  };
  ASSERT_FALSE(other.change(id, turn).has_value());
  EXPECT_EQ(asked.recall(one.scene).value().value().policy, manoeuvre::PolicyId::aes_left);
}

// Who holds the file is told, and when it is free again the store answers as before.
TEST_F(Memory, AnswersAgainWhenAnotherProcessLetsTheFileGo) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(1)).has_value());
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  const auto held = store.recall(example_case(1).scene);
  ASSERT_FALSE(held.has_value());
  EXPECT_EQ(held.error().code, Error::Code::too_late);
  EXPECT_THAT(held.error().message, HasSubstr("bank.db"));
  EXPECT_THAT(held.error().message, HasSubstr("another process"));
  sqlite3_close(other);
  EXPECT_EQ(store.recall(example_case(1).scene).value().value().similarity, 1.0);
  EXPECT_TRUE(store.add(example_case(2)).has_value());
}

// What was read is still known; what would be written to a file that nobody finds again is refused.
TEST_F(Memory, TellsThatItsFileHasVanished) {
  Store store = opened();
  ASSERT_TRUE(store.add(example_case(1)).has_value());
  fs::remove(path_);
  EXPECT_EQ(store.recall(example_case(1).scene).value().value().found.id, 1);
  const auto added = store.add(example_case(2));
  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error().code, Error::Code::unwritable);
  EXPECT_THAT(added.error().message, HasSubstr("bank.db"));
}

TEST_F(Memory, TakesCasesFromTwoProcessesAtOnce) {
  constexpr int num_cases = 20;
  {
    Adder one(path_, num_cases);  // the file is not there yet: they also race to make it
    Adder other(path_, num_cases);
    EXPECT_EQ(one.wait(), 0);
    EXPECT_EQ(other.wait(), 0);
  }
  const std::vector<Case> cases = opened().all().value();
  EXPECT_EQ(cases.size(), 2U * num_cases);
  std::map<std::string, int> num_of;
  for (const Case& one : cases) {
    ++num_of[one.source];
  }
  EXPECT_EQ(num_of.size(), std::size_t{num_cases});
  for (const auto& [source, count] : num_of) {
    EXPECT_EQ(count, 2) << source;
  }
  EXPECT_EQ(integrity(), "ok");
}

// The promise of `add`: what was reported is there after SIGKILL at any time. Kills per run:
// SACA_SOAK_KILLS, else few, to be quick.
TEST_F(Memory, KeepsEveryReportedCaseWhenItsProcessIsKilled) {
  const char* wanted = std::getenv("SACA_SOAK_KILLS");
  const int num_kills = wanted == nullptr ? 12 : std::atoi(wanted);
  std::mt19937 rng(1);
  std::uniform_int_distribution<int> delay(0, 20'000);  // [us]: about ten additions
  std::vector<match::CaseId> reported;
  std::size_t num_reported = 0;
  for (int i = 0; i < num_kills; ++i) {
    Adder adder(path_, 1'000'000);
    if (i % 3 != 0) {
      reported.push_back(adder.next().value());  // not before it is at work
    }
    adder.kill_after(std::chrono::microseconds(delay(rng)));
    EXPECT_EQ(adder.wait(), -1);
    while (const auto id = adder.next()) {
      reported.push_back(*id);
    }
    if (i % 100 == 99 || i + 1 == num_kills) {
      Store store = opened();
      for (const match::CaseId id : reported) {
        ASSERT_TRUE(store.find(id).value().has_value()) << "case " << id << " after kill " << i;
      }
      for (const Case& one : store.all().value()) {
        expect_same(one, example_case(static_cast<std::uint32_t>(std::stoi(one.source.substr(5)))));
      }
      ASSERT_EQ(integrity(), "ok");
      num_reported += reported.size();
      reported.clear();
      fs::remove(path_);  // a bank of thousands takes each process longer to open than it may live
    }
  }
  EXPECT_GT(num_reported, static_cast<std::size_t>(num_kills) / 2);
  RecordProperty("reported", static_cast<int>(num_reported));
}

}  // namespace
}  // namespace saca::memory::store_test
