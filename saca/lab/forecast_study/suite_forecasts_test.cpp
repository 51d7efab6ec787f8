#include "saca/lab/forecast_study/suite_forecasts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/eval/scenes_for_test.h"

namespace saca::forecast_study::suite_forecasts_test {
namespace {

/// A car that brakes, but the second encounter cannot be drawn.
Result<eval::SuiteEncounter> every_other(std::uint64_t number) {
  if (number == 1) {
    return Error{Error::Code::out_of_range, "encounter 1 is none"};
  }
  return eval::SuiteEncounter{
      .number = number, .family = "queue", .scenario = eval::car_that_brakes(), .twin = {}};
}

TEST(SuiteForecasts, ComeInTheOrderOfTheEncountersOnAnyNumberOfThreads) {
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  const eval::WatchingModels models = eval::shipped_models();
  SuiteStudy study{.at = every_other,
                   .count = 3,
                   .perceiver = {&car, &harm, &intent::shipped_model()},
                   .mixture = models.mixture,
                   .play = {.seed = 1, .exact = true},
                   .threads = 1};
  const ForecastStudy found = suite_forecasts(study);
  ASSERT_EQ(found.encounters.size(), 3U);
  EXPECT_TRUE(found.notes.empty());
  EXPECT_EQ(found.encounters[0].family, "queue");
  EXPECT_EQ(found.encounters[1].problem, "encounter 1 is none");
  EXPECT_TRUE(found.encounters[1].samples.empty());
  // It brakes from 2 s on, so that it acts where 6 / 2 (2 - d)^2 > 1 m within 2 s, d until then.
  ASSERT_FALSE(found.encounters[2].samples.empty());
  for (const eval::ForecastSample& one : found.encounters[2].samples) {
    EXPECT_EQ(one.who, "car1");
    EXPECT_EQ(one.acts, one.time > 0.8) << one.time;
  }
  study.threads = 2;
  const ForecastStudy again = suite_forecasts(study);
  ASSERT_EQ(again.encounters[2].samples.size(), found.encounters[2].samples.size());
  for (std::size_t i = 0; i < found.encounters[2].samples.size(); ++i) {
    EXPECT_EQ(again.encounters[2].samples[i].mean_miss_of_6,
              found.encounters[2].samples[i].mean_miss_of_6);
  }
}

TEST(PlacesModel, IsReadByItsName) {
  EXPECT_TRUE(read_places_model("models", "model").has_value());
  const auto none = read_places_model("models", "of_nowhere");
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, testing::HasSubstr("models/places/of_nowhere.safetensors"));
}

}  // namespace
}  // namespace saca::forecast_study::suite_forecasts_test
