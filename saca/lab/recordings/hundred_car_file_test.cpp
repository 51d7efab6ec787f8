#include "saca/lab/recordings/hundred_car_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace saca::recordings::hundred_car_file_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A row of 79 zeros but for the columns given (counted from 1, as in the dictionary).
std::string row(std::initializer_list<std::pair<int, std::string>> columns) {
  std::string text;
  for (int column = 1; column <= 79; ++column) {
    std::string field = "0";
    for (const auto& [at, value] : columns) {
      field = at == column ? value : field;
    }
    text += (column == 1 ? "" : ",") + field;
  }
  return text + "\n";
}

std::string problem(const std::string& text) {
  const auto rows = read_hundred_car_rows(text, "f.txt", 7);
  return rows.has_value() ? "no problem" : rows.error().message;
}

// 10 mph = 4.4704 m/s, 100 ft = 30.48 m, 10 ft/s = 3.048 m/s: exact by definition.
TEST(ReadHundredCarRows, TurnsUnitsAndSigns) {
  const auto rows = read_hundred_car_rows(row({{1, "7"},
                                               {2, "41"},
                                               {5, "10"},
                                               {7, "-3"},
                                               {78, "1"},
                                               {22, "55"},
                                               {36, "100"},
                                               {50, "-10"},
                                               {64, "0.02"},
                                               {34, "9"},
                                               {48, "50"},
                                               {62, "5"},
                                               {76, "0.02"}}),
                                          "f.txt", 7);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  const HundredCarRow& got = rows.value().at(0);
  EXPECT_EQ(got.sync, 41);
  EXPECT_DOUBLE_EQ(got.speed, 4.4704);
  EXPECT_NEAR(got.yaw_rate, -0.0523599, 1e-7);
  EXPECT_TRUE(got.brake);
  ASSERT_EQ(got.front.size(), 1U);
  EXPECT_EQ(got.front[0].id, 55);
  EXPECT_DOUBLE_EQ(got.front[0].range, 30.48);
  EXPECT_DOUBLE_EQ(got.front[0].rate, -3.048);
  EXPECT_DOUBLE_EQ(got.front[0].azimuth, -0.02);  // to the right of a radar that looks ahead
  ASSERT_EQ(got.rear.size(), 1U);
  EXPECT_EQ(got.rear[0].id, 9);
  EXPECT_DOUBLE_EQ(got.rear[0].range, 15.24);
  EXPECT_DOUBLE_EQ(got.rear[0].azimuth, 0.02);  // its right is the car's left
}

// 1 in = 0.0254 m, 1 g = 9.80665 m/s^2: exact by definition.
TEST(ReadHundredCarRows, TurnsLaneMarksToTheLeft) {
  const auto rows = read_hundred_car_rows(row({{1, "7"},
                                               {10, "-0.5"},
                                               {15, "-100"},
                                               {16, "50"},
                                               {19, "1024"},
                                               {20, "700"},
                                               {78, "."}}) +
                                              row({{1, "7"}, {2, "1"}, {19, "1024"}, {20, "."}}),
                                          "f.txt", 7);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  const HundredCarRow& got = rows.value().at(0);
  EXPECT_DOUBLE_EQ(got.acceleration, -4.903325);
  EXPECT_DOUBLE_EQ(got.left_mark, 2.54);
  EXPECT_DOUBLE_EQ(got.right_mark, -1.27);
  EXPECT_EQ(got.mark_trust, 700.0);
  EXPECT_FALSE(got.brake_known);
  EXPECT_EQ(rows.value().at(1).mark_trust, 0.0);
  EXPECT_TRUE(rows.value().at(1).brake_known);
}

TEST(ReadHundredCarRows, KnowsWhatIsMissing) {
  const auto rows = read_hundred_car_rows(
      row({{1, "7"}, {2, "1"}, {5, "-1"}, {7, "."}, {79, ""}}) + "\r\n", "f.txt", 7);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  EXPECT_TRUE(std::isnan(rows.value()[0].speed));
  EXPECT_TRUE(std::isnan(rows.value()[0].yaw_rate));
  EXPECT_TRUE(rows.value()[0].front.empty());
}

// 1,100 ft/s = 335 m/s, as the release has it of what is nowhere.
TEST(ReadHundredCarRows, LeavesOutWhatNoRadarSees) {
  const auto rows = read_hundred_car_rows(row({{1, "7"},
                                               {21, "55"},
                                               {35, "100"},
                                               {49, "-1100"},
                                               {22, "56"},
                                               {36, "3000"},
                                               {23, "57"},
                                               {37, "100"},
                                               {51, "-10"}}),
                                          "f.txt", 7);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  ASSERT_EQ(rows.value()[0].front.size(), 1U);
  EXPECT_EQ(rows.value()[0].front[0].id, 57);
}

TEST(ReadHundredCarRows, PicksTheEventFromACompiledFile) {
  const std::string text = row({{1, "6"}, {2, "9"}}) + row({{1, "7"}, {2, "1"}}) +
                           row({{1, "7"}, {2, "2"}}) + row({{1, "8"}, {2, "5"}});
  const auto rows = read_hundred_car_rows(text, "f.txt", 7);
  ASSERT_TRUE(rows.has_value());
  EXPECT_EQ(rows.value().size(), 2U);
}

TEST(ReadHundredCarRows, NamesWhatIsWrong) {
  const std::string good = row({{1, "7"}, {2, "1"}});
  EXPECT_THAT(problem(good + "7,2,3\n"), HasSubstr("f.txt:2: want 79 columns, got 3"));
  EXPECT_THAT(problem(good + row({{1, "7"}, {2, "2"}, {36, "12ft"}})),
              AllOf(HasSubstr("f.txt:2: column 36"), HasSubstr("`12ft`")));
  EXPECT_THAT(problem(row({{1, "7"}, {2, "1"}, {5, "nan"}})), HasSubstr("column 5"));
  EXPECT_THAT(problem(good + row({{1, "7"}, {2, "3"}})), HasSubstr("(sync): want 2, got 3"));
  EXPECT_THAT(problem(row({{1, "8"}})), HasSubstr("want rows of event 7"));
  EXPECT_THAT(problem(""), HasSubstr("got none"));
}

TEST(CutHundredCarEvent, TakesRowsOnEndOfOneEvent) {
  std::string_view rest = "6,1\n6,2\n7,9\n6,3";
  EXPECT_EQ(cut_hundred_car_event(rest), "6,1\n6,2\n");
  EXPECT_EQ(cut_hundred_car_event(rest), "7,9\n");
  EXPECT_EQ(cut_hundred_car_event(rest), "6,3");
  EXPECT_TRUE(rest.empty());
  EXPECT_EQ(hundred_car_number(" 7,9\n"), 7);
  for (const std::string_view row : {"", "x,1", "nan,1", "1.5,1", "-1,1", "1e10,1"}) {
    EXPECT_EQ(hundred_car_number(row), std::nullopt) << row;
  }
  EXPECT_TRUE(is_hundred_car_series("HundredCar_Public_8911.txt"));
  EXPECT_FALSE(is_hundred_car_series(hundred_car_table));
}

TEST(ReadHundredCarEvent, NamesWhatIsWrong) {
  const auto message = [](std::string_view text) {
    return read_hundred_car_event(text, "t.txt", 7).error().message;
  };
  EXPECT_THAT(message("8\t1\n"), HasSubstr("want a row of event 7"));
  EXPECT_THAT(message("7\t1\n"), HasSubstr("t.txt:1: want 69 tab-separated columns, got 2"));
  std::string dots;
  for (int k = 4; k < 69; ++k) {
    dots += "\t.";
  }
  EXPECT_THAT(message("7\t1\tsoon\t9" + dots), HasSubstr("`soon`"));
  EXPECT_THAT(message("7\tmine\t1\t9" + dots), HasSubstr("`mine`"));
}

}  // namespace
}  // namespace saca::recordings::hundred_car_file_test
