#include "saca/base/core/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace saca::csv_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array<std::string_view, 3> known{"time_s", "speed_mps", "a_x_mps2"};

std::string refusal(std::string_view text) {
  const auto table = read_csv(text, "log.csv", known);
  return table.has_value() ? "accepted" : table.error().message;
}

TEST(Csv, NumbersStandUnderTheirNames) {
  const CsvTable table =
      read_csv("# a car\ntime_s, speed_mps\n0,20.5\n\n0.01,-2e1\n", "log.csv", known).value();
  EXPECT_THAT(table.names, ElementsAre("time_s", "speed_mps"));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(0.0, 0.01), ElementsAre(20.5, -20.0)));
  EXPECT_THAT(table.lines, ElementsAre(3, 5));
}

TEST(Csv, OtherLineEndsAMarkOfByteOrderAndNoEndOfTheLastLineChangeNothing) {
  const CsvTable table = read_csv("\xEF\xBB\xBFtime_s\r\n1\r\n2", "log.csv", known).value();
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1.0, 2.0)));
}

TEST(Csv, WhatIsNoNumberIsNamedWithItsPlace) {
  for (const std::string bad : {"nan", "inf", "-inf", "1e999", "fast", "", "1.5m", "0x10", "1 2"}) {
    EXPECT_THAT(
        refusal("time_s,speed_mps\n0,20\n1," + bad + "\n"),
        AllOf(HasSubstr("log.csv:3: speed_mps: want a finite number"), HasSubstr("`" + bad + "`")));
  }
}

TEST(Csv, RowsThatAreTooShortOrTooLongAreRefused) {
  EXPECT_THAT(refusal("time_s,speed_mps\n0\n"), HasSubstr("log.csv:2: want 2 columns, got 1"));
  EXPECT_THAT(refusal("time_s,speed_mps\n0,1,\n"), HasSubstr("want 2 columns, got 3"));
}

TEST(Csv, NamesAreKnownAndThereOnce) {
  EXPECT_THAT(refusal("time_s,speed_kmh\n0,1\n"),
              AllOf(HasSubstr("log.csv:1: unknown column `speed_kmh`"), HasSubstr("speed_mps")));
  EXPECT_THAT(refusal("time_s,time_s\n0,1\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal("time_s;speed_mps\n0;1\n"), HasSubstr("semicolons"));
  EXPECT_THAT(refusal("0,1\n1,2\n"), HasSubstr("unknown column `0`"));
}

TEST(Csv, NothingIsNoTable) {
  EXPECT_THAT(refusal(""), HasSubstr("log.csv: want rows"));
  EXPECT_THAT(refusal("\n\n# nothing\n"), HasSubstr("an empty file"));
  EXPECT_THAT(refusal("time_s,speed_mps\n"), HasSubstr("only a line of names"));
}

TEST(Csv, BytesThatCannotBePrintedAreNotPrinted) {
  EXPECT_THAT(refusal(std::string_view("time_s\n\0\x1b[31m\n", 14)), HasSubstr("`??[31m`"));
}

TEST(Fields, AreOneMoreThanTheMarks) {
  EXPECT_THAT(fields_of("a,,b,", ','), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(fields_of("", ','), ElementsAre(""));
}

}  // namespace
}  // namespace saca::csv_test
