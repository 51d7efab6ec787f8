#include "saca/lab/forecast_study/study_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::forecast_study::study_request_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(StudyRequest, PlaysTheEncountersOfASuite) {
  const suites::SuiteRequest request{.name = "crossing", .count = 1, .threads = 1};
  const auto study = study_of(installation::here_for_test(), request);
  ASSERT_TRUE(study.has_value()) << study.error().message;
  const StudyFigures figures = figures_of(study.value(), 1);
  EXPECT_EQ(figures.num_encounters, 1U);
  EXPECT_EQ(figures.num_failed, 0);
  EXPECT_GT(figures.num_forecasts, 0U);
  EXPECT_EQ(command_text(request),
            "saca forecast eval crossing --count 1 --split calibration --car compact_rwd_ev "
            "--seed 1");
}

TEST(StudyRequest, TrafficNeedsFolders) {
  EXPECT_THAT(study_of(installation::here_for_test(), {.name = "traffic"}).error().message,
              HasSubstr("--data: want folders"));
}

TEST(FanRequest, DrawsOneRoadUser) {
  FanRequest request{.from = {.name = "crossing"}, .encounter = 0, .who = "car1", .at = 1.0};
  const auto here = installation::here_for_test();
  const auto picture = picture_of(here, request);
  ASSERT_TRUE(picture.has_value()) << picture.error().message;
  EXPECT_THAT(picture.value(), StartsWith("<svg"));
  request.who = "car9";
  EXPECT_THAT(picture_of(here, request).error().message, StartsWith("crossing 0: "));
}

TEST(FanRequest, NeedsAnEncounterThatIsThere) {
  const FanRequest request{.from = {.name = "table_2"}, .encounter = 1'000'000, .who = "car1"};
  const auto picture = picture_of(installation::here_for_test(), request);
  EXPECT_FALSE(picture.has_value());
}

}  // namespace
}  // namespace saca::forecast_study::study_request_test
