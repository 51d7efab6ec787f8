#include "saca/lab/suites/traffic_page.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/traffic_for_test.h"

namespace saca::suites::traffic_page_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

report::SuitePage page(const WatchedTraffic& traffic) {
  return traffic_page(traffic, {}, {{"meta.seed", "9"}, {"traffic.drives", 2}});
}

TEST(TrafficPage, TellsRatesAndTheRule) {
  const report::SuitePage told = page(made_traffic());
  EXPECT_EQ(told.title, "Normal driving, in shadow");
  EXPECT_THAT(told.lines.at(0),
              HasSubstr("watched 1.00 hours and 50.0 km of recorded driving (2 drives)"));
  EXPECT_THAT(told.lines.at(0), HasSubstr("2 times a conflict came within T1: 1 times there was "
                                          "danger by the rule below, 1 times there was none; 0 "
                                          "times it stood. It would have acted 1 times, 1 of them "
                                          "before T1; 0 times there was danger"));
  EXPECT_THAT(told.lines.at(1), HasSubstr("track has only begun or is about to end."));
  ASSERT_EQ(told.tables.size(), 2U);
  ASSERT_EQ(told.tables[0].rows.size(), 3U);
  EXPECT_EQ(told.tables[0].rows[0].name, "i80");
  EXPECT_EQ(told.tables[0].rows[2].name, "all");
  for (const report::PageTable& table : told.tables) {
    for (const report::PageTable::Row& row : table.rows) {
      EXPECT_EQ(row.cells.size(), table.columns.size());
    }
  }
}

// What SACA did for nothing, then the false trigger, then that in danger.
TEST(TrafficPage, WhatCountsAgainstSacaStandsFirst) {
  const report::PageTable table = page(made_traffic()).tables.at(1);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].name, "i80: a");
  EXPECT_EQ(table.rows[0].cells[0], "SACA begins AEB before T1");
  EXPECT_EQ(table.rows[0].cells[1], "4.50");
  EXPECT_EQ(table.rows[0].cells[5], "false: nothing needed");
  EXPECT_EQ(table.rows[0].cells[9], "more than 12");
  EXPECT_EQ(table.rows[1].cells[0], "T1 has come");
  EXPECT_EQ(table.rows[2].cells[5], "danger: driver braked");
  EXPECT_EQ(table.rows[2].cells[9], "3.2");
  EXPECT_TRUE(table.rows[2].faded);
}

TEST(TrafficPage, ADriveThatCannotBeOpenedHasNoPicture) {
  EXPECT_TRUE(page(made_traffic()).gallery.empty());
}

TEST(TrafficPage, SaysHowItWasMadeAndWhatWasNotWatched) {
  EXPECT_THAT(page(made_traffic()).footnotes,
              ElementsAre("seed: 9", "3 drives drawn of 12",
                          "CommonRoad: 4 tracks of other than cars are no egos",
                          "not watched: 1 x us101: no lane"));
}

TEST(TrafficPage, OfManyReasonsSomeAreTold) {
  WatchedTraffic traffic = made_traffic();
  for (int k = 0; k < 40; ++k) {
    traffic.rows.push_back(
        {.source = "us101", .drive = "d", .left_out = std::to_string(k), .watched = {}});
  }
  const auto footnotes = page(traffic).footnotes;
  EXPECT_EQ(footnotes.back(), "and others");
  EXPECT_EQ(footnotes.size(), 23U);  // 20 and a note, one more, and that there are others
}

}  // namespace
}  // namespace saca::suites::traffic_page_test
