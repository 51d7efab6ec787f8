#include "saca/lab/tune/minimise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"

namespace saca::tune::minimise_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Minimise : public testing::Test {
 protected:
  void TearDown() override { fs::remove(journal_); }

  // Rastrigin's function: one minimum at (0.3, -0.7), 0, among about a hundred others.
  Problem problem() {
    return {.name = "rastrigin",
            .low = {-5.0, -5.0},
            .high = {5.0, 5.0},
            .start = {4.0, 4.0},
            .cost = [this](const std::vector<double>& x) {
              ++num_calls_;
              const auto wave = [](double d) {
                return d * d + 10.0 - 10.0 * std::cos(2.0 * std::numbers::pi * d);
              };
              return wave(x[0] - 0.3) + wave(x[1] + 0.7);
            }};
  }

  // Stops after so many evaluations of this call.
  static std::function<bool(const Progress&)> after(int most) {
    return [most, done = 0](const Progress&) mutable { return ++done < most; };
  }
  static bool never(const Progress& /*progress*/) { return true; }

  const fs::path journal_ =
      fs::path(testing::TempDir()) /
      ("saca_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  const Effort effort_{.evaluations = 3000, .seed = 3};
  int num_calls_ = 0;
};

TEST_F(Minimise, FindsTheDeepestOfManyMinima) {
  const auto found = minimise(problem(), effort_, journal_, never);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_TRUE(found.value().has_value());
  EXPECT_NEAR(found.value()->at[0], 0.3, 1e-3);
  EXPECT_NEAR(found.value()->at[1], -0.7, 1e-3);
  EXPECT_LT(found.value()->cost, 1e-3);
  EXPECT_LE(num_calls_, 3000);
}

TEST_F(Minimise, StoppedAndResumedEndsAsIfItNeverStopped) {
  const auto whole = minimise(problem(), effort_, journal_, never).value();
  const int whole_calls = num_calls_;
  fs::remove(journal_);
  num_calls_ = 0;
  int rounds = 0;
  std::optional<Minimum> found;
  while (!found) {
    // Each round goes 300 further than what is remembered.
    found = minimise(problem(), effort_, journal_, after(300 * ++rounds)).value();
    ASSERT_LT(rounds, 20);
  }
  EXPECT_GT(rounds, 2);
  EXPECT_EQ(num_calls_, whole_calls);  // nothing is worked out twice
  EXPECT_EQ(found->at, whole->at);
  EXPECT_EQ(found->cost, whole->cost);
  EXPECT_EQ(found->evaluations, whole->evaluations);
}

TEST_F(Minimise, ALineThatAKillCutShortIsWorkedOutAgain) {
  const auto whole = minimise(problem(), effort_, journal_, never).value();
  const std::string text = read_file(journal_).value();
  ASSERT_EQ(write_file(journal_, text.substr(0, text.size() / 2)), std::nullopt);
  const auto found = minimise(problem(), effort_, journal_, never);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found.value()->at, whole->at);
  EXPECT_EQ(read_file(journal_).value(), text);
}

TEST_F(Minimise, SameSeedSameSearch) {
  const auto a = minimise(problem(), effort_, journal_, never).value();
  fs::remove(journal_);
  const auto b = minimise(problem(), effort_, journal_, never).value();
  fs::remove(journal_);
  const auto c = minimise(problem(), {3000, 4}, journal_, never).value();
  EXPECT_EQ(a->at, b->at);
  EXPECT_NE(a->at, c->at);
}

TEST_F(Minimise, RefusesAnotherJournal) {
  ASSERT_TRUE(minimise(problem(), effort_, journal_, after(10)).has_value());
  const auto other = minimise(problem(), {3000, 4}, journal_, never);
  ASSERT_FALSE(other.has_value());
  EXPECT_THAT(other.error().message, HasSubstr("seed 3"));
  EXPECT_THAT(other.error().message, HasSubstr("seed 4"));
  Problem elsewhere = problem();
  elsewhere.start = {3.0, 3.0};
  EXPECT_FALSE(minimise(elsewhere, effort_, journal_, never).has_value());
  const std::string text = read_file(journal_).value();
  ASSERT_EQ(write_file(journal_, text + "much\n"), std::nullopt);
  const auto broken = minimise(problem(), effort_, journal_, never);
  ASSERT_FALSE(broken.has_value());
  EXPECT_THAT(broken.error().message, HasSubstr("want a cost, got \"much\""));
}

TEST_F(Minimise, SaysWhereItCannotWrite) {
  const auto found = minimise(problem(), effort_, "/no/such/folder/journal", never);
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Error::Code::unwritable);
  EXPECT_THAT(found.error().message, HasSubstr("/no/such/folder"));
}

TEST_F(Minimise, RefusesWhatIsNoProblem) {
  Problem empty = problem();
  empty.start.clear();
  EXPECT_THROW((void)minimise(empty, effort_, journal_, never), ContractViolation);
}

}  // namespace
}  // namespace saca::tune::minimise_test
