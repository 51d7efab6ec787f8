#include "saca/lab/suites/recorded_drives.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/suites/traffic_for_test.h"

namespace saca::suites::recorded_drives_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string release = "saca/lab/recordings/testdata";  // tests run in the project's folder

fs::path empty_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("saca_recorded_drives_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// The release alone, without the CommonRoad file that lies beside it.
fs::path study() {
  const fs::path folder = empty_folder("study");
  fs::copy(fs::path(release) / "meta", folder / "meta");
  fs::copy(fs::path(release) / "timeseries", folder / "timeseries");
  return folder;
}

TEST(FindDrives, OfTheStudyAreItsEventsUntilTheConflict) {
  const auto found = find_drives({study()});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_EQ(found.value().drives.size(), 1U);
  const DriveToWatch& drive = found.value().drives[0];
  EXPECT_EQ(drive.source, "100car");
  EXPECT_EQ(drive.name, "event 8911");
  EXPECT_THAT(drive.command, HasSubstr("--event 8911 --before-s "));
  const auto ego = drive.open();
  ASSERT_TRUE(ego.has_value()) << ego.error().message;
  EXPECT_EQ(ego.value().window.from, 1.0);
  EXPECT_GT(ego.value().window.until, 1.0);
}

TEST(FindDrives, HashesAllFiles) {
  const fs::path folder = study();
  const auto before = find_drives({folder}).value().hash.value();
  EXPECT_EQ(find_drives({folder}).value().hash.value(), before);
  ASSERT_FALSE(write_file(folder / "more.txt", "more").has_value());
  EXPECT_NE(find_drives({folder}).value().hash.value(), before);
}

TEST(FindDrives, RefusesWhatIsNoFolderOrHoldsNothing) {
  EXPECT_EQ(find_drives({"no_such_folder"}).error().message,
            "no_such_folder: want a folder, got none");
  const fs::path folder = empty_folder("nothing");
  ASSERT_FALSE(write_file(folder / "readme.txt", "nothing").has_value());
  const auto found = find_drives({folder});
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Error::Code::malformed);
  EXPECT_THAT(found.error().message, HasSubstr("got neither"));
}

TEST(FindDrives, NamesABrokenMap) {
  const fs::path folder = empty_folder("broken");
  ASSERT_FALSE(write_file(folder / "a.xml", "<commonRoad").has_value());
  EXPECT_THAT(find_drives({folder}).error().message, HasSubstr("a.xml"));
}

TEST(DrawnDrives, AreSomeOfEachSource) {
  std::vector<DriveToWatch> all;
  for (int k = 0; k < 20; ++k) {
    all.push_back(made_drive(k < 12 ? "us101" : "i80", std::to_string(k)));
  }
  const auto drawn = drawn_drives(all, 5, 1);
  ASSERT_EQ(drawn.size(), 10U);
  const auto again = drawn_drives(all, 5, 1);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    EXPECT_EQ(drawn[k].source, k < 5 ? "i80" : "us101");
    EXPECT_EQ(drawn[k].name, again[k].name);
  }
  EXPECT_EQ(drawn_drives(all, 100, 1).size(), 20U);
  EXPECT_TRUE(drawn_drives({}, 5, 1).empty());
}

}  // namespace
}  // namespace saca::suites::recorded_drives_test
