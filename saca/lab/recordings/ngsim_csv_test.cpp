#include "saca/lab/recordings/ngsim_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace saca::recordings::ngsim_csv_test {
namespace {

using ::testing::HasSubstr;

const std::string official =
    "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_length,v_"
    "Width,v_Class,v_Vel,"
    "v_Acc,Lane_ID,O_Zone,D_Zone,Int_ID,Section_ID,Direction,Movement,Preceding,Following,Space_"
    "Headway,Time_Headway,"
    "Location\n";
/// Vehicle 515 in frame 2330, recorded from 1118846747000 ms on: minute 18647445.8 since 1970.
const std::string row_515 =
    "515,2330,1123,1118846980000,10,20,6451137.641,1873344.962,15,6,2,33.5,-1,2,,,,,,,500,523,119."
    "1,5.11,us-101\n";

struct Read {
  NgsimTable table;
  std::string problem;
};

Read read_all(const std::string& text) {
  Read read;
  NgsimReader reader("f.csv", read.table);
  reader.take(text);
  const auto problem = reader.finish();
  read.problem = problem ? problem->message : "";
  return read;
}

/// With one piece of the text replaced.
std::string with(const std::string& text, const std::string& old_piece, const std::string& piece) {
  std::string made = text;
  return made.replace(made.find(old_piece), old_piece.size(), piece);
}

// 1 ft = 0.3048 m: exact by definition.
TEST(NgsimCsv, TurnsFeetAndFindsTheRecording) {
  const Read read = read_all(official + row_515);
  ASSERT_EQ(read.problem, "");
  ASSERT_EQ(read.table.recordings.size(), 1U);
  const auto& [key, rows] = *read.table.recordings.begin();
  EXPECT_EQ(key.site, "us101");
  EXPECT_EQ(key.minute, 18647446);  // (1118846980000 - 2330 * 100) / 60000 = 18647445.8
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].vehicle, 515);
  EXPECT_EQ(rows[0].frame, 2330);
  EXPECT_DOUBLE_EQ(rows[0].right, 3.048);
  EXPECT_DOUBLE_EQ(rows[0].along, 6.096);
  EXPECT_DOUBLE_EQ(rows[0].length, 4.572);
  EXPECT_DOUBLE_EQ(rows[0].width, 1.8288);
  EXPECT_DOUBLE_EQ(rows[0].speed, 33.5 * 0.3048);
  EXPECT_EQ(rows[0].vehicle_class, 2);
  EXPECT_EQ(rows[0].lane, 2);
  EXPECT_EQ(rows[0].preceding, 500);
  EXPECT_TRUE(std::isnan(rows[0].lead_along));
}

TEST(NgsimCsv, ReadsTheOlderFilesWithoutNames) {
  const std::string row =
      "  515 2330 1123 1118846980000 10.0 20.0 6451137.6 1873344.9 15.0 6.0 2 33.5 -1.0 2 500 523 "
      "119.1 5.11 \r\n";
  const Read read = read_all(row + row);
  ASSERT_EQ(read.problem, "");
  const auto& [key, rows] = *read.table.recordings.begin();
  EXPECT_EQ(key.site, "ngsim");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_DOUBLE_EQ(rows[0].along, 6.096);
  EXPECT_EQ(rows[0].preceding, 500);
}

TEST(NgsimCsv, ReadsPairsInMetres) {
  const Read read = read_all(
      "pair_id,time,duration,vehicle_id,frame_id,local_x,local_y,v_length,v_width,v_class,v_vel,v_"
      "acc,lane_id,"
      "preceding,space_headway,time_headway,preceding_local_y,preceding_length,preceding_width,"
      "preceding_class,"
      "preceding_vel,preceding_acc\n"
      "47-39,0,32.1,47,510,2.4,22.16,4.54,1.8,2,3.64,1.1,1,39,18.4,2.63,37.21,4.82,1.95,2,7.98,1."
      "36\n");
  ASSERT_EQ(read.problem, "");
  const auto& [key, rows] = *read.table.recordings.begin();
  EXPECT_EQ(key.site, "i80");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].along, 22.16);
  EXPECT_EQ(rows[0].speed, 3.64);
  EXPECT_EQ(rows[0].lead_along, 37.21);
  EXPECT_EQ(rows[0].lead_length, 4.82);
  EXPECT_EQ(rows[0].lead_speed, 7.98);
}

TEST(NgsimCsv, TakesPiecesOfAnySize) {
  const std::string text = "\xEF\xBB\xBF" + official + row_515 + "\r\n" + row_515;
  for (const std::size_t size : {1U, 7U, 100U, 100000U}) {
    NgsimTable table;
    NgsimReader reader("f.csv", table);
    for (std::size_t from = 0; from < text.size(); from += size) {
      reader.take(std::string_view(text).substr(from, size));
    }
    EXPECT_EQ(reader.finish(), std::nullopt);
    EXPECT_EQ(table.recordings.begin()->second.size(), 2U) << size;
  }
}

TEST(NgsimCsv, RecordingsOfOneFileAreKeptApart) {
  const Read read = read_all(official + row_515 + with(row_515, "1118846980000", "1118847880000") +
                             with(row_515, "us-101", "i-80"));
  ASSERT_EQ(read.problem, "");
  EXPECT_EQ(read.table.recordings.size(), 3U);
}

TEST(NgsimCsv, CountsWhatItPassesOver) {
  const Read read =
      read_all(official + row_515 + with(row_515, "us-101", "lankershim") + row_515.substr(0, 40));
  ASSERT_EQ(read.problem, "");
  EXPECT_EQ(read.table.recordings.size(), 1U);
  EXPECT_EQ(read.table.skipped.at("row: of an arterial, whose lanes need a map"), 1U);
  EXPECT_EQ(read.table.skipped.at("row: the last one, without a line's end"), 1U);
  // Cut within its last word, it would be of a site that there is not.
  const Read cut = read_all(official + row_515 + row_515.substr(0, row_515.size() - 2));
  EXPECT_EQ(cut.table.recordings.size(), 1U);
}

TEST(NgsimCsv, NamesWhatIsWrong) {
  const auto problem = [](const std::string& text) { return read_all(text).problem; };
  EXPECT_THAT(problem(""), HasSubstr("want at least one row, got none"));
  EXPECT_THAT(problem(official), HasSubstr("want at least one row, got none"));
  EXPECT_THAT(problem("Vehicle_ID,Colour\n"),
              HasSubstr("f.csv:1: want columns of NGSIM, got one named `colour`"));
  EXPECT_THAT(problem("Vehicle_ID,Frame_ID\n"), HasSubstr("want a column global_time, got none"));
  EXPECT_THAT(problem(with(official, "Frame_ID", "Vehicle_ID")), HasSubstr("two named vehicle_id"));
  EXPECT_THAT(problem(official + "1,2,3\n" + row_515),
              HasSubstr("f.csv:2: want 25 columns, got 3"));
  EXPECT_THAT(problem(official + with(row_515, "10,20", "nan,20")),
              HasSubstr("f.csv:2: column local_x: want a number, got `nan`"));
  EXPECT_THAT(problem(official + with(row_515, "10,20", ",20")),
              HasSubstr("column local_x: want a number"));
  EXPECT_THAT(problem(official + with(row_515, "10,20", "1e9,20")),
              HasSubstr("column local_x: want a number from"));
  EXPECT_THAT(problem(official + with(row_515, ",15,6,", ",0,6,")), HasSubstr("column v_length"));
  EXPECT_THAT(problem(official + with(row_515, "33.5", "-3")), HasSubstr("column v_vel"));
  EXPECT_THAT(problem(official + with(row_515, "515,", "515.5,")),
              HasSubstr("column vehicle_id: want a whole number"));
  EXPECT_THAT(problem(official + std::string(20'000, 'x')),
              HasSubstr("f.csv:2: want lines of at most"));
  std::string arterial;
  for (int k = 0; k < 24; ++k) {
    arterial += "1 ";
  }
  EXPECT_THAT(problem(arterial + "\n"), HasSubstr("got an arterial's of 24"));
  EXPECT_THAT(problem("1 2 3\n4 5 6\n"), HasSubstr("f.csv:1: want 18 columns, got 3"));
}

}  // namespace
}  // namespace saca::recordings::ngsim_csv_test
