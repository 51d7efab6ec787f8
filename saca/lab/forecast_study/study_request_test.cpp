#include "saca/lab/forecast_study/study_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

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
            "forecast eval crossing --count 1 --split calibration --car compact_rwd_ev "
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
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "study_request_scenarios";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file("scenarios/one_way.toml", folder / "one_way.toml",
                             std::filesystem::copy_options::overwrite_existing);
  const auto problem = [&](std::uint64_t encounter) {
    const FanRequest request{
        .from = {.name = folder.string()}, .encounter = encounter, .who = "car1", .at = 1.0};
    return picture_of(installation::here_for_test(), request).error().message;
  };
  EXPECT_THAT(problem(1), HasSubstr("want an encounter below 1, got 1"));
  EXPECT_THAT(problem(std::uint64_t{1} << 32), HasSubstr("want an encounter below"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace saca::forecast_study::study_request_test
