#include "saca/lab/recordings/pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "saca/base/core/file.h"

namespace saca::recordings::pack_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A lane of 300 m and cars that drive along it.
std::string file_with_cars(const std::string& source, int cars, int first_id = 30) {
  std::string text = R"(<?xml version="1.0"?>
<commonRoad commonRoadVersion="2020a" benchmarkID="USA_US101-1_1_T-1" source=")" +
                     source + R"(" timeStepSize="0.1" author="" affiliation="">
<location><gpsLatitude>999</gpsLatitude><gpsLongitude>999</gpsLongitude></location>
<lanelet id="1">
<leftBound><point><x>0</x><y>2</y></point><point><x>300</x><y>2</y></point></leftBound>
<rightBound><point><x>0</x><y>-2</y></point><point><x>300</x><y>-2</y></point></rightBound>
</lanelet>
)";
  const auto state = [](const char* name, int step, double x, double speed) {
    return "<" + std::string(name) + "><position><point><x>" + std::to_string(x) +
           "</x><y>0</y></point></position><orientation><exact>0</exact></"
           "orientation><time><exact>" +
           std::to_string(step) + "</exact></time><velocity><exact>" + std::to_string(speed) +
           "</exact></velocity></" + name + ">\n";
  };
  for (int car = 0; car < cars; ++car) {
    text += "<dynamicObstacle id=\"" + std::to_string(first_id + car) +
            "\"><type>car</type><shape><rectangle><length>4.5</length><width>1.8</width>"
            "</rectangle></shape>\n";
    double x = 20.0 + 40.0 * car;
    for (int k = 0; k < 15; ++k) {
      const double speed = 8.0 + 0.2 * k * (1 + car);
      if (k == 1) {
        text += "<trajectory>";
      }
      text += state(k == 0 ? "initialState" : "state", k, x, speed);
      x += 0.1 * speed;
    }
    text += "</trajectory></dynamicObstacle>\n";
  }
  return text + "</commonRoad>\n";
}

class Pack : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("pack_") + test->name());
    fs::create_directories(folder_ / "deep");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) const {
    ASSERT_EQ(write_file(folder_ / name, text), std::nullopt);
  }
  [[nodiscard]] Result<PackResult> packed() const {
    return pack_commonroad(files_in({folder_}, ".xml").value(), {});
  }

  fs::path folder_;
};

TEST_F(Pack, FindsFilesInAndBelowFolders) {
  put("b.xml", "");
  put("deep/a.xml", "");
  put("c.txt", "");
  const auto files = files_in({folder_, folder_ / "b.xml", folder_ / "c.txt"}, ".xml");
  ASSERT_TRUE(files.has_value());
  EXPECT_EQ(files.value(),
            (std::vector<fs::path>{folder_ / "b.xml", folder_ / "c.txt", folder_ / "deep/a.xml"}));
  const auto none = files_in({folder_ / "nowhere"}, ".xml");
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, HasSubstr("nowhere"));
}

TEST_F(Pack, MakesOneSetOfManyFiles) {
  put("a.xml", file_with_cars("recorded", 2));
  put("deep/b.xml", file_with_cars("recorded", 1, 50));
  const auto made = packed();
  ASSERT_TRUE(made.has_value()) << made.error().message;
  ASSERT_EQ(made.value().set.recordings.size(), 2U);
  EXPECT_EQ(made.value().set.recordings[0].name, "a.xml");
  EXPECT_EQ(made.value().set.recordings[0].site, "us101");
  EXPECT_EQ(made.value().set.recordings[0].group, "us101-1");
  EXPECT_EQ(made.value().set.recordings[1].group, "us101-2");
  EXPECT_EQ(counts_of(made.value().set).samples, 45U);
  EXPECT_EQ(broken_rule(made.value().set), std::nullopt);
  EXPECT_TRUE(made.value().refused.empty());
}

TEST_F(Pack, CountsFilesThatItCannotUse) {
  put("a.xml", file_with_cars("recorded", 1));
  put("b.xml", file_with_cars("NGSIM (SPOT)", 1));
  put("c.xml", "<commonRoad");
  put("d.xml", file_with_cars("recorded", 0));
  put("e.xml", file_with_cars("recorded", 1));  // as a.xml
  const auto made = packed();
  ASSERT_TRUE(made.has_value());
  const auto& skipped = made.value().set.skipped;
  EXPECT_EQ(skipped.at("file: set-based predictions (SPOT), no recording"), 1U);
  EXPECT_EQ(skipped.at("file or event: cannot be read"), 1U);
  EXPECT_EQ(skipped.at("file or event: no vehicle with enough samples"), 1U);
  EXPECT_EQ(skipped.at("file: all its vehicles are kept from others"), 1U);
  ASSERT_EQ(made.value().refused.size(), 1U);
  EXPECT_THAT(made.value().refused[0], HasSubstr("c.xml"));
}

TEST_F(Pack, RefusesWhenNothingIsLeft) {
  put("c.xml", "<commonRoad");
  EXPECT_THAT(packed().error().message, HasSubstr("c.xml"));
  put("c.xml", file_with_cars("SPOT", 1));
  EXPECT_THAT(packed().error().message, HasSubstr("want recorded vehicles, got none in 1 files"));
}

TEST_F(Pack, TellsItsProgressAndStopsWhenTold) {
  put("a.xml", file_with_cars("recorded", 1));
  put("b.xml", file_with_cars("recorded", 1, 50));
  std::vector<std::size_t> told;
  const auto stopped =
      pack_commonroad(files_in({folder_}, ".xml").value(), [&](std::size_t done, std::size_t all) {
        told.push_back(done);
        EXPECT_EQ(all, 2U);
        return false;
      });
  EXPECT_EQ(told, std::vector<std::size_t>{1});
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().code, Error::Code::too_late);
}

TEST_F(Pack, MakesASetOfEvents) {
  const fs::path release =
      "saca/lab/recordings/testdata";  // rows 281 to 342 of event 8911, car 1006
  put("HundredCar_Public_4711.txt", "4711,1,2\n");
  put("other.txt", "anything");
  const auto files = files_in({release, folder_}, ".txt").value();
  const auto made = pack_hundred_car(files, {});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  ASSERT_EQ(made.value().set.recordings.size(), 1U);
  const Recording& recording = made.value().set.recordings[0];
  EXPECT_EQ(recording.name, "event 8911");
  EXPECT_EQ(recording.group, "100car-1006");
  EXPECT_EQ(recording.vehicles.at(0).samples.size(), 62U);
  EXPECT_NEAR(recording.vehicles[0].samples[0].speed, 44.738726 * 0.44704, 1e-9);  // its first row
  EXPECT_EQ(broken_rule(made.value().set), std::nullopt);
  ASSERT_EQ(made.value().refused.size(), 1U);
  EXPECT_THAT(made.value().refused[0], HasSubstr("4711"));
}

TEST_F(Pack, TakesAFileOfManyEvents) {
  const std::string rows =
      read_file("saca/lab/recordings/testdata/timeseries/HundredCar_Public_8911.txt").value();
  std::string other;
  for (std::string_view rest = rows; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n') + 1);
    other += "77" + std::string(line.substr(4));
    rest.remove_prefix(line.size());
  }
  const std::string line =
      read_file("saca/lab/recordings/testdata/meta/100CarEventVideoReducedData_v1_5.txt").value();
  const std::string last = line.substr(line.rfind("8911\t"));
  put("100CarEventVideoReducedData_v1_5.txt", last + "\n77\t1010" + last.substr(9) + "\n");
  put("HundredCar_Crash_Public_Compiled.txt", other + rows + "soon,1,2\n");
  const auto made = pack_hundred_car(files_in({folder_}, ".txt").value(), {});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  ASSERT_EQ(made.value().set.recordings.size(), 2U);
  EXPECT_EQ(made.value().set.recordings[0].name, "event 77");
  EXPECT_EQ(made.value().set.recordings[0].group, "100car-1010");
  EXPECT_EQ(made.value().set.recordings[1].name, "event 8911");
  EXPECT_EQ(made.value().set.recordings[1].vehicles[0].samples.size(), 62U);
  ASSERT_EQ(made.value().refused.size(), 1U);
  EXPECT_THAT(made.value().refused[0], HasSubstr("event soon: want a whole number"));
}

TEST_F(Pack, WantsATableOfEvents) {
  put("HundredCar_Public_4711.txt", "4711,1,2\n");
  const auto made = pack_hundred_car(files_in({folder_}, ".txt").value(), {});
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error().message, HasSubstr("want a table of events"));
}

}  // namespace
}  // namespace saca::recordings::pack_test
