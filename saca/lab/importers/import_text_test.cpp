#include "saca/lab/importers/import_text.h"

#include <gmock/gmock.h>

namespace saca::importers::import_text_test {
namespace {

TEST(AnEventsText, TellsRowsAndHowTheLeadWasSeen) {
  HundredCarReport report;
  report.first_row = 3;
  report.last_row = 170;
  report.lead.num_seen = 120;
  report.lead.num_gaps = 2;
  report.lead.num_outliers = 1;
  EXPECT_EQ(import_text(report, {.event = 4711}, "a.toml"),
            "a.toml: event 4711, rows 3 to 170; lead seen in 120 rows, 2 gaps bridged, "
            "1 outliers\n");
}

TEST(AReleasesText, CountsByReasonInWords) {
  EXPECT_EQ(import_text(std::vector<HundredCarOutcome>{
                {.made = HundredCarImport()},
                {.made = HundredCarRefusal{HundredCarReason::leaves_road, ""}},
                {.made = HundredCarRefusal{HundredCarReason::leaves_road, ""}}}),
            "3 events: 1 rebuilt, 2 refused\n"
            "      2 leaves_road              as rebuilt the driver leaves the road\n");
  EXPECT_EQ(import_text(std::vector<HundredCarOutcome>()), "0 events: 0 rebuilt, 0 refused\n");
}

TEST(ATrafficsText, TellsWhomItHoldsHowWellItFitsAndWhatIsNotInIt) {
  TrafficImport made;
  made.scenario.duration = 6.5;
  made.scenario.actors.resize(3);
  made.report.lane.ahead = 100.0;
  made.report.lane.rms = 0.06;
  made.report.lane.largest = 0.25;
  made.report.rms_shift = 0.37;
  made.report.largest_shift = 0.75;
  made.report.num_outliers = 7;
  made.report.left_out = {{"gone before", 2}};
  made.report.ignored = {{"scenario/signs", 3}};
  const std::string rest =
      "  lane: an arc over 100 m ahead, 0.06 m off rms, 0.25 m at most\n"
      "  smoothing: 0.37 m rms, 0.75 m at most, 7 outliers\n"
      "  left out: 2 gone before\n"
      "  ignored: 3 scenario/signs\n";
  EXPECT_EQ(import_text(made, {.ego = 42}, "a.toml"),
            "a.toml: 3 vehicles around obstacle 42, 6.5 s\n" + rest);
  EXPECT_EQ(import_text(made, {}, "a.toml"),
            "a.toml: 3 vehicles around the planning problem's start, 6.5 s\n" + rest);
}

}  // namespace
}  // namespace saca::importers::import_text_test
