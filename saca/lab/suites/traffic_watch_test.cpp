#include "saca/lab/suites/traffic_watch.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/suites/traffic_for_test.h"

namespace saca::suites::traffic_watch_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// The one event of the excerpt of the 100-Car study, by which nobody decides.
class TrafficWatchTest : public testing::Test {
 protected:
  TrafficWatchTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const fs::path release = "saca/lab/recordings/testdata";
    fs::copy(release / "meta", folder_ / "meta");
    fs::copy(release / "timeseries", folder_ / "timeseries");
    watch_.folders = {folder_.string()};
    watch_.output = (folder_.parent_path() / "saca_traffic_watch_out").string();
    fs::remove(journal());
  }
  ~TrafficWatchTest() override {
    fs::remove_all(folder_);
    fs::remove(journal());
  }

  [[nodiscard]] fs::path journal() const { return watch_.output + ".journal"; }
  [[nodiscard]] Result<std::optional<WatchedTraffic>> watched() const {
    return watch_traffic(watch_,
                         {.car = &car_, .intent = &intent::shipped_model(), .saca = nullptr}, "1.2",
                         long_work::ProgressDisplay::silent);
  }

  fs::path folder_ = fs::path(testing::TempDir()) / "saca_traffic_watch_test";
  manoeuvre::Car car_ = prepare::default_car();
  TrafficWatch watch_;
};

TEST_F(TrafficWatchTest, GivesARowForEachDriveAndKeepsIt) {
  const auto first = watched();
  ASSERT_TRUE(first.has_value()) << first.error().message;
  const WatchedTraffic& traffic = first.value().value();
  EXPECT_EQ(traffic.found, 1U);
  ASSERT_EQ(traffic.rows.size(), 1U);
  EXPECT_EQ(traffic.rows[0].source, "100car");
  EXPECT_EQ(traffic.rows[0].drive, "event 8911");
  EXPECT_EQ(traffic.rows[0].left_out, "");
  EXPECT_GT(traffic.rows[0].watched.seconds, 0.0);
  EXPECT_TRUE(traffic.rows[0].watched.interventions.empty());
  EXPECT_THAT(read_file(journal()).value(),
              HasSubstr("saca 1.2 suite traffic, compact_rwd_ev, seed 1, count 1000, T1 1.3 s, T2 "
                        "5.5 s, danger from 4 and 3 m/s^2 on, data "));
  const auto again = watched();
  EXPECT_EQ(line_of(again.value().value().rows[0]), line_of(traffic.rows[0]));
}

TEST_F(TrafficWatchTest, AJournalOfAnotherDriveIsRefused) {
  ASSERT_TRUE(watched().has_value());
  std::string text = read_file(journal()).value();
  text.replace(text.find("event 8911"), 10, "event 8912");
  ASSERT_FALSE(write_file(journal(), text).has_value());
  EXPECT_EQ(watched().error().message, journal().string() + ": line 2: another drive's");
}

TEST_F(TrafficWatchTest, AFolderThatIsNotThereIsNamed) {
  watch_.folders = {"no_such_folder"};
  EXPECT_EQ(watched().error().message, "no_such_folder: want a folder, got none");
}

TEST(TrafficCommand, WatchesTheSameAgain) {
  TrafficWatch watch;
  watch.folders = {"a"};
  watch.thresholds.trigger = 1.5;
  EXPECT_EQ(command_of(watch),
            "saca suite traffic --data a --count 1000 --seed 1 --car compact_rwd_ev --t1-s 1.5");
}

TEST(TrafficSources, AreNamedOnce) {
  EXPECT_THAT(sources_of(made_traffic()), ElementsAre("i80", "us101"));
  EXPECT_TRUE(sources_of({}).empty());
}

}  // namespace
}  // namespace saca::suites::traffic_watch_test
