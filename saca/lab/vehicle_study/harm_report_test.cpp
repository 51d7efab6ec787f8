#include "saca/lab/vehicle_study/harm_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/prepare/harm_file.h"

namespace saca::vehicle_study::harm_report_test {
namespace {

using testing::HasSubstr;

class HarmReport : public testing::Test {
 protected:
  const collision::HarmModel model_ = prepare::read_harm("data/harm.toml").value();
};

TEST_F(HarmReport, EveryRiskHasAValueForEachSpeed) {
  const nlohmann::json all = json_of(model_);
  EXPECT_EQ(all.at("schema"), "saca.harm/1");
  const auto speeds = all.at("speed_mps").get<std::vector<double>>();
  ASSERT_EQ(speeds.size(), 8U);
  EXPECT_NEAR(speeds.front(), 10.0 / 3.6, 1e-12);
  EXPECT_NEAR(speeds.back(), 100.0 / 3.6, 1e-12);
  for (const char* table : {"probability", "harm"}) {
    EXPECT_FALSE(all.at(table).empty());
    for (const auto& [key, values] : all.at(table).items()) {
      EXPECT_EQ(values.size(), speeds.size()) << key;
    }
  }
  const double front = collision::occupant_injury(model_, collision::Face::front, speeds[4]).severe;
  EXPECT_NEAR(all.at("probability").at("occupant_front_severe").at(4).get<double>(), front, 1e-12);
}

TEST_F(HarmReport, TheTextHasSpeedsAboveTheirColumns) {
  const std::string text = text_of(model_, "a.toml");
  EXPECT_THAT(text,
              testing::StartsWith(
                  "From a.toml. Probabilities are what is due to the impact.\n\nprobability "));
  EXPECT_THAT(text, HasSubstr("     10     20     30     40     50     60     80    100   km/h\n"));
  EXPECT_THAT(text, HasSubstr("\nweighted harm of one person "));
  EXPECT_THAT(text, HasSubstr("   over delta-v\n"));
  EXPECT_THAT(text, HasSubstr("   over closing speed\n"));
}

}  // namespace
}  // namespace saca::vehicle_study::harm_report_test
