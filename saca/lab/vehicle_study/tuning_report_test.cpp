#include "saca/lab/vehicle_study/tuning_report.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/prepare/tuning_file.h"

namespace saca::vehicle_study::tuning_report_test {
namespace {

TunedCar tuned() {
  return {"saca tune --car a_car", "a.tuning.toml", prepare::default_car().tuning, {1.25, 2.5}};
}

TEST(TuningReport, TheFileSaysHowItWasFoundAndIsReadAgain) {
  const std::string text = tuning_file_of(tuned());
  EXPECT_THAT(text, testing::HasSubstr("Made by: saca tune --car a_car\n"));
  EXPECT_THAT(text, testing::HasSubstr(
                        "Costs: lane change 1.2500, T-drift 2.5000 (saca/lab/tune/trials.h).\n"));
  const auto file = std::filesystem::path(testing::TempDir()) / "tuning_report.toml";
  ASSERT_EQ(write_file(file, text), std::nullopt);
  EXPECT_EQ(prepare::read_tuning(file).value().swerve.share, tuned().tuning.swerve.share);
}

TEST(TuningReport, TheDocumentHasCostsAndTheDomain) {
  const nlohmann::json all = json_of(tuned());
  EXPECT_EQ(all.at("schema"), "saca.tune/1");
  EXPECT_EQ(all.at("output"), "a.tuning.toml");
  EXPECT_EQ(all.at("swerve_cost"), 1.25);
  EXPECT_EQ(all.at("drift_cost"), 2.5);
  EXPECT_EQ(all.at("drift_grip"), nlohmann::json({0.2, 0.3, 0.5, 0.7, 0.9, 1.0}));
  EXPECT_EQ(all.at("drift_slowest_mps"), nlohmann::json(tuned().tuning.domain.slowest));
  EXPECT_EQ(all.at("drift_fastest_mps"), nlohmann::json(tuned().tuning.domain.fastest));
}

TEST(TuningReport, OneLineForPeople) {
  EXPECT_EQ(text_of(tuned()), "a.tuning.toml: lane change 1.2500, T-drift 2.5000\n");
}

}  // namespace
}  // namespace saca::vehicle_study::tuning_report_test
