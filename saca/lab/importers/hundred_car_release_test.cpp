#include "saca/lab/importers/hundred_car_release.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/base/core/file.h"

namespace saca::importers::hundred_car_release_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path testdata = "saca/lab/recordings/testdata";  // tests run in the project folder
const fs::path series = testdata / "timeseries/HundredCar_Public_8911.txt";
const fs::path table = testdata / "meta" / std::string(recordings::hundred_car_table);

/// A folder of its own, with the excerpt's table of events.
fs::path folder_of(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("saca_hundred_cars_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::copy_file(table, folder / table.filename());
  return folder;
}

void write(const fs::path& path, const std::string& text) {
  ASSERT_FALSE(write_file(path, text).has_value());
}

TEST(ImportHundredCars, RebuildsTheExcerptAsAlone) {
  std::size_t files = 0;
  const auto all = import_hundred_cars(testdata, {}, [&](std::size_t done, std::size_t of) {
    files += done == of ? of : 0;
    return true;
  });
  ASSERT_TRUE(all.has_value()) << all.error().message;
  ASSERT_EQ(all.value().size(), 1U);
  EXPECT_EQ(files, 1U);
  const HundredCarOutcome& outcome = all.value()[0];
  EXPECT_EQ(outcome.event, 8911);
  EXPECT_EQ(outcome.severity, "Near-Crash");
  ASSERT_NE(outcome.rebuilt(), nullptr) << outcome.refusal()->message;
  EXPECT_EQ(outcome.refusal(), nullptr);
  EXPECT_TRUE(refusals(all.value()).empty());
  const auto alone = import_hundred_car(testdata, {.event = 8911});
  EXPECT_EQ(scenario::write_scenario(outcome.rebuilt()->scenario),
            scenario::write_scenario(alone.value().scenario));
}

// One file of three events: one good, one that the table does not have, one torn.
TEST(ImportHundredCars, RefusesWhatItCannotReadAndGoesOn) {
  const fs::path folder = folder_of("many");
  const std::string good = read_file(series).value();
  write(folder / "HundredCar_Crash_Public_Compiled.txt",
        "name,of,columns\n\n17,1,2\n" + good + "\n18,1\n");
  write(folder / "HundredCar_Public_8911.txt", good);  // once more
  const auto all = import_hundred_cars(folder, {}, {});
  ASSERT_TRUE(all.has_value()) << all.error().message;
  ASSERT_EQ(all.value().size(), 3U);
  EXPECT_EQ(all.value()[0].event, 17);
  EXPECT_THAT(all.value()[0].refusal()->message, HasSubstr("want a row of event 17"));
  EXPECT_EQ(all.value()[2].event, 8911);
  const auto counts = refusals(all.value());
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_EQ(counts.at(HundredCarReason::unreadable), 2U);
}

TEST(ImportHundredCars, RowsOfOneEventInTwoPlacesMustBeTheSame) {
  const fs::path folder = folder_of("twice");
  const std::string good = read_file(series).value();
  write(folder / "HundredCar_a.txt", good);
  write(folder / "HundredCar_b.txt", good.substr(0, good.rfind('\n', good.size() - 2) + 1));
  const auto all = import_hundred_cars(folder, {}, {});
  ASSERT_EQ(all.value().size(), 1U);
  ASSERT_NE(all.value()[0].refusal(), nullptr);
  EXPECT_EQ(all.value()[0].refusal()->reason, HundredCarReason::unreadable);
  EXPECT_THAT(all.value()[0].refusal()->message, HasSubstr("HundredCar_b.txt"));
}

TEST(ImportHundredCars, SaysWhatIsMissingAndStopsWhenTold) {
  EXPECT_EQ(import_hundred_cars("/nowhere", {}, {}).error().code, Error::Code::unreadable);
  EXPECT_THAT(import_hundred_cars(testdata / "timeseries", {}, {}).error().message,
              HasSubstr("want a table of events"));
  EXPECT_THAT(import_hundred_cars(folder_of("empty"), {}, {}).error().message,
              HasSubstr("want series"));
  const auto stopped =
      import_hundred_cars(testdata, {}, [](std::size_t, std::size_t) { return false; });
  EXPECT_EQ(stopped.error().code, Error::Code::too_late);
}

}  // namespace
}  // namespace saca::importers::hundred_car_release_test
