#include "saca/lab/suites/suite_text.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_text_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string text(const SuiteRun& run) {
  SuiteRequest request;
  request.name = "natural";
  request.threads = 2;
  return text_of(run, result_of(run, 1), request);
}

TEST(SuiteText, HasALineForEachMethod) {
  SuiteRun run =
      made_run({"saca", "aeb"}, {made_row(0, "a", {0.1, 0.3}, 0.1), failed_row(1, "a", "no road")});
  run.notes = {"Made by hand."};
  const std::string told = text(run);
  EXPECT_THAT(told, StartsWith("natural: 2 encounters, 1 could not be played; means with 95 % "
                               "intervals\nMade by hand.\n\nmethod "));
  EXPECT_THAT(told, HasSubstr("\naeb                    0.3000 (0.3000 to 0.3000)  0.2000 (0.2000 "
                              "to 0.2000)  "));
  EXPECT_THAT(told, Not(HasSubstr("encounters/s")));
  EXPECT_THAT(told, Not(HasSubstr("recorded drivers")));
  EXPECT_THAT(told,
              HasSubstr("\n1 of 2 encounters are left out; the first: encounter 1 could not be "
                        "played: no road\n"));
}

TEST(SuiteText, TellsWhoThinksWhoDroveAndWhatFailed) {
  SuiteRun run = made_run({"saca"}, {made_row(0, "a", {0.1}, 0.1), made_row(1, "a", {0.1}, 0.1),
                                     made_row(2, "a", {0.1}, 0.1)});
  run.rows[0].risk.runs[0].thinking = encounter::ThinkingFigures{.forecasts = 5, .recalled = 3};
  run.rows[0].driver = eval::DriverRow{.harm = 0.2, .met = "car", .impact_speed = 3.0};
  run.rows[1].driver = eval::DriverRow{.steers = 1};
  run.rows[2].risk.runs[0].fault = "it threw";
  run.worked = 1;
  run.seconds = 0.5;
  const std::string told = text(run);
  EXPECT_THAT(told, HasSubstr("of 5 forecasts memory knew 3"));
  EXPECT_THAT(told, HasSubstr("\n2 recorded drivers: harm 0.1000, 1 met somebody, 0 braked, 1 "
                              "moved aside\n  saca does as the driver did in 0 % of those who met "
                              "nobody\n"));
  EXPECT_THAT(told, HasSubstr("\n2.0 encounters/s on 2 threads\n"));
  EXPECT_THAT(told,
              HasSubstr("\n1 of 3 encounters are left out; the first: encounter 2 saca failed: "
                        "it threw\n"));
  run.rows[1].driver->met = "car";
  EXPECT_THAT(text(run), Not(HasSubstr("does as the driver did"))) << "nobody met nobody";
}

}  // namespace
}  // namespace saca::suites::suite_text_test
