#include "saca/lab/danger_study/data_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "saca/base/core/file.h"
#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/danger/car_limits.h"

namespace saca::danger_study::data_set_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DataSets : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "data_set" /
                           testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  /// Parts of one drive each.
  [[nodiscard]] DataSetTask task(const std::string& name) const {
    return {.folder = folder_ / name,
            .car_as_asked_for = "cars/compact.toml",
            .car = {"compact", prepare::default_car()},
            .transitions = 600,
            .drives_per_part = 1,
            .tables = TableUse::none,
            .display = long_work::ProgressDisplay::silent};
  }
  static danger::DangerModel model() {
    const manoeuvre::Car car = prepare::default_car();
    return {danger::avoidance_of(car, 0.9), manoeuvre::footprint(car), {}};
  }
  static Result<DataSetCounts> made(const DataSetTask& task) {
    auto set = DataSet::open(task);
    return set.has_value() ? std::move(set).value().make(model())
                           : Result<DataSetCounts>(set.error());
  }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    return read_file(folder_ / name).value();
  }
};

TEST_F(DataSets, AreTheSameByAnyThreadsAndGoOn) {
  const auto first = made(task("a"));
  ASSERT_TRUE(first.has_value()) << first.error().message;
  EXPECT_GE(first.value().transitions, 600);
  EXPECT_EQ(first.value().situations, 10 * first.value().drives);
  DataSetTask by_three = task("b");
  by_three.threads = 3;
  EXPECT_EQ(made(by_three).value(), first.value());
  EXPECT_EQ(bytes("a/part_00000.h5"), bytes("b/part_00000.h5"));

  const std::string part = bytes("a/part_00000.h5");
  fs::remove(folder_ / "a" / "part_00000.h5");
  EXPECT_EQ(made(task("a")).value(), first.value());
  EXPECT_EQ(bytes("a/part_00000.h5"), part);
  DataSetTask more = task("a");
  more.transitions = 2 * first.value().transitions;
  EXPECT_GE(made(more).value().transitions, more.transitions);
  EXPECT_EQ(bytes("a/part_00000.h5"), part);
}

TEST_F(DataSets, TellWhatTheyAre) {
  const auto all = made(task("a"));
  ASSERT_TRUE(all.has_value());
  EXPECT_THAT(bytes("a/README.md"), HasSubstr("(car cars/compact.toml, seed 1)"));
  EXPECT_THAT(bytes("a/README.md"),
              HasSubstr(std::to_string(all.value().transitions) + " transitions of 0.1 s in "));
  EXPECT_THAT(bytes("a/journal.txt"),
              testing::StartsWith("saca.transitions/1, car compact, seed 1, 1 drives a part, "));
  EXPECT_THAT(bytes("a/journal.txt"), HasSubstr("features, no tables\n0 "));
  EXPECT_EQ(learned_danger::read_part(folder_ / "a" / "part_00000.h5").value().car, "compact");
}

TEST_F(DataSets, OfAnotherTaskAreOthers) {
  ASSERT_TRUE(DataSet::open(task("a")).has_value());
  const auto refused = [&](const DataSetTask& other) {
    const auto opened = DataSet::open(other);
    return opened.has_value() ? "" : opened.error().message;
  };
  EXPECT_EQ(refused(task("a")), "");
  DataSetTask other = task("a");
  other.seed = 2;
  EXPECT_THAT(refused(other), HasSubstr("journal.txt"));
  other = task("a");
  other.network = blind_network();
  EXPECT_THAT(refused(other), HasSubstr("journal.txt"));
  other = task("a");
  other.tables = TableUse::solved;
  EXPECT_THAT(refused(other), HasSubstr("journal.txt"));
}

TEST_F(DataSets, OfOutcomesHaveASituationForEachDrive) {
  DataSetTask outcomes = task("a");
  outcomes.network = blind_network();
  outcomes.outcomes = true;
  outcomes.drives_per_part = 20;
  const auto all = made(outcomes);
  ASSERT_TRUE(all.has_value());
  EXPECT_EQ(all.value().situations, all.value().drives);
}

TEST_F(DataSets, NameAFolderThatCannotBeMade) {
  fs::create_directories(folder_);
  ASSERT_EQ(write_file(folder_ / "file", "no folder"), std::nullopt);
  const auto refused = DataSet::open(task("file/a"));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr("file/a"));
}

TEST(DataSetParts, ComeBackFromTheirLines) {
  const DataSetCounts one{.transitions = 1, .drives = 2, .situations = 3, .near = 4, .bytes = 5};
  EXPECT_EQ(part_line(7, one), "7 1 2 3 4 5");
  const auto back = part_from("7 1 2 3 4 5");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->first, 7U);
  EXPECT_EQ(back->second, one);
  for (const char* const line : {"", "7", "7 1 2 3 4", "7 1 2 3 4 -5", "a 1 2 3 4 5"}) {
    EXPECT_EQ(part_from(line), std::nullopt) << line;
  }
}

TEST(DataSetReport, HasItsFigures) {
  const DataSetTask task{.folder = "d/a", .car_as_asked_for = "c.toml", .seed = 3, .threads = 2};
  const DataSetCounts all{
      .transitions = 10, .drives = 2, .situations = 4, .near = 1, .bytes = 1'234'000'000};
  EXPECT_EQ(json_of(task, all, 1.5), (nlohmann::json{{"danger.dataset.transitions", 10},
                                                     {"danger.dataset.drives", 2},
                                                     {"danger.dataset.situations", 4},
                                                     {"danger.dataset.near_boundary", 1},
                                                     {"danger.dataset.bytes", 1'234'000'000},
                                                     {"danger.dataset.seconds", 1.5},
                                                     {"meta.car", "c.toml"},
                                                     {"meta.seed", "3"},
                                                     {"meta.threads", 2}}));
  EXPECT_EQ(text_of(task, all),
            "10 transitions in 4 situations, 1 of which start near the boundary, of 2 drives\n"
            "1.23 GB in d/a\n");
}

using DataSetsDeathTest = DataSets;

/// An interrupt stays one: it gets a process of its own.
TEST_F(DataSetsDeathTest, StopAtAnInterrupt) {
  EXPECT_EXIT(
      {
        long_work::watch_for_interrupt();
        (void)std::raise(SIGINT);
        const auto none = made(task("a"));
        const bool right = !none.has_value() && none.error().code == Error::Code::too_late &&
                           !fs::exists(folder_ / "a" / "README.md");
        std::_Exit(right ? EXIT_SUCCESS : EXIT_FAILURE);
      },
      testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace
}  // namespace saca::danger_study::data_set_test
