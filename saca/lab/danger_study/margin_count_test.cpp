#include "saca/lab/danger_study/margin_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "saca/base/core/file.h"
#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::danger_study::margin_count_test {
namespace {

using testing::HasSubstr;

SituationsTask task(int situations) {
  return {.situations = situations, .threads = 2, .display = long_work::ProgressDisplay::silent};
}

class MarginCounts : public testing::Test {
 protected:
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".margins.json");
  void SetUp() override { std::filesystem::remove(path_); }
  void TearDown() override { std::filesystem::remove(path_); }

  [[nodiscard]] Result<MarginCount> counted(MarginCount from, int situations) const {
    return counted_on(std::move(from), "a", path_, prepare::default_car(), blind_network(),
                      task(situations));
  }
};

TEST_F(MarginCounts, GoOnFromTheirFile) {
  const MarginCount none = read_margin_count(path_, "a").value();
  EXPECT_EQ(none.situations, 0);
  ASSERT_TRUE(counted(none, 30).has_value());
  const auto kept = read_margin_count(path_, "a");
  ASSERT_TRUE(kept.has_value()) << kept.error().message;
  EXPECT_EQ(kept.value().situations, 30);
  const auto gone_on = counted(kept.value(), 50);
  ASSERT_TRUE(gone_on.has_value());
  EXPECT_EQ(gone_on.value().situations, 50);
  int before = 0;
  int after = 0;
  for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
    EXPECT_GE(gone_on.value().told[bin].hits_with(0).of, kept.value().told[bin].hits_with(0).of);
    before += kept.value().told[bin].hits_with(0).of;
    after += gone_on.value().told[bin].hits_with(0).of;
  }
  EXPECT_GT(before, 5) << "the blind take most for safe";
  EXPECT_GT(after, before);
  EXPECT_LE(after - before, 20);
  EXPECT_EQ(json_of(read_margin_count(path_, "a").value(), "a"), json_of(gone_on.value(), "a"));
}

TEST_F(MarginCounts, AreTheSameByAnyThreads) {
  SituationsTask alone = task(20);
  alone.threads = 1;
  const auto by_one =
      counted_on({}, "a", path_, prepare::default_car(), blind_network(), alone).value();
  EXPECT_EQ(json_of(by_one, "a"), json_of(counted({}, 20).value(), "a"));
}

TEST_F(MarginCounts, HaveTheirSchemaAndEveryBin) {
  MarginCount count{.situations = 7, .told = {}};
  count.told[learned_danger::bin_of(true, 10.0, 0.3, 1)].add(-0.3, true);
  const nlohmann::json all = json_of(count, "weights 1, seed 2");
  EXPECT_EQ(all.at("schema"), "saca.margins/2");
  EXPECT_EQ(all.at("of"), "weights 1, seed 2");
  EXPECT_EQ(all.at("situations"), 7);
  EXPECT_EQ(all.at("told_safe").size(), 16U);
  ASSERT_EQ(write_file(path_, all.dump()), std::nullopt);
  const auto back = read_margin_count(path_, "weights 1, seed 2").value();
  EXPECT_EQ(back.told[learned_danger::bin_of(true, 10.0, 0.3, 1)].hits_with(0).count, 1);
}

TEST_F(MarginCounts, OfSomethingElseAreRefused) {
  const auto refused = [&](const std::string& text) {
    EXPECT_EQ(write_file(path_, text), std::nullopt);
    const auto read = read_margin_count(path_, "a");
    return read.has_value() ? "" : read.error().message;
  };
  const std::string head = path_.string() + ": want an unfinished count of margins of a, got ";
  const std::string tail = "; delete it to begin anew";
  EXPECT_EQ(refused("no count"), head + "something else" + tail);
  EXPECT_EQ(refused("{\"schema\": 3}"), head + "something else" + tail);
  nlohmann::json all = json_of({}, "b");
  EXPECT_EQ(refused(all.dump()), head + "one of other weights or another seed" + tail);
  all["of"] = "a";
  EXPECT_EQ(refused(all.dump()), "");
  all["told_safe"]["straight.below_20_mps.slippery.one"] = {1, 2};
  EXPECT_EQ(refused(all.dump()), head + "numbers that are none" + tail);
  all.erase("told_safe");
  EXPECT_THAT(refused(all.dump()), HasSubstr("told_safe"));
}

TEST_F(MarginCounts, AreNamedByWeightsAndSeed) {
  EXPECT_THAT(margin_count_of(blind_network(), 3),
              testing::MatchesRegex("weights [0-9a-f]{16}, seed 3"));
}

TEST_F(MarginCounts, TellWhereTheirFileCannotBeWritten) {
  const auto refused =
      counted_on({}, "a", path_ / "x", prepare::default_car(), blind_network(), task(1));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
}

using MarginCountsDeathTest = MarginCounts;

/// An interrupt stays one: it gets a process of its own.
TEST_F(MarginCountsDeathTest, StopAtAnInterrupt) {
  EXPECT_EXIT(
      {
        long_work::watch_for_interrupt();
        (void)std::raise(SIGINT);
        const auto none = counted({}, 10);
        const bool right = !none.has_value() && none.error().code == Error::Code::too_late;
        std::_Exit(right ? EXIT_SUCCESS : EXIT_FAILURE);
      },
      testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace
}  // namespace saca::danger_study::margin_count_test
