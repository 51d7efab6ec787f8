#include "saca/eval/suite.h"

#include <gmock/gmock.h>

#include "saca/eval/scenes_for_test.h"
#include "saca/intent/shipped_model.h"

namespace saca::eval::suite_test {
namespace {

using manoeuvre::PolicyId;

class SuiteTest : public testing::Test {
 protected:
  SuiteRow run(std::vector<std::string> methods, std::uint64_t number = 4) {
    SuiteEncounter encounter{
        .number = number, .family = "made", .scenario = standing_car(19.0, 60.0), .twin = {}};
    encounter.twin = encounter.scenario;
    encounter.twin->actors.clear();
    return run_encounter(encounter, {.methods = std::move(methods), .seed = 2},
                         {.forecast = {&car_, &harm_}, .clock = &clock_}, intent::shipped_model());
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = manoeuvre::default_car();
  outcome::HarmModel harm_ = shipped_harm();
};

TEST_F(SuiteTest, SameSeedSameLine) {
  const SuiteRow row = run({"aeb", "random"});
  EXPECT_EQ(line_of(row), line_of(run({"aeb", "random"})));
  EXPECT_NE(line_of(row), line_of(run({"aeb", "random"}, 5)));  // other draws
  ASSERT_TRUE(row.twin.has_value());
  EXPECT_FALSE(row.twin->runs[0].intervened());
}

TEST_F(SuiteTest, ALineComesBack) {
  const SuiteRow row = run({"aeb", "nothing"});
  const auto back = suite_row_from(line_of(row), 2);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(line_of(back.value()), line_of(row));
  EXPECT_EQ(back.value().risk.runs[1].harm, row.risk.runs[1].harm);
  EXPECT_THAT(suite_row_from(line_of(row), 3).error().message,
              testing::HasSubstr("want runs of 3 methods, got 2"));
  for (const char* const spoilt :
       {"", "{", "[]", R"({"number": -1})", R"({"number": 1, "family": 7})"}) {
    EXPECT_FALSE(suite_row_from(spoilt, 2).has_value()) << spoilt;
  }
}

TEST(DriverRowTest, AgreesWhereBothBrakeOrNotAndGoToTheSameSide) {
  using manoeuvre::Plan;
  const DriverRow brakes{.brakes = true};
  EXPECT_TRUE(agrees(brakes, Plan{PolicyId::aeb, std::nullopt}));
  EXPECT_FALSE(agrees(brakes, Plan{PolicyId::es_b_left, 5.0}));
  EXPECT_FALSE(agrees(brakes, std::nullopt));
  const DriverRow both{.brakes = true, .steers = -1};
  EXPECT_TRUE(agrees(both, Plan{PolicyId::es_b_right, 5.0}));
  EXPECT_FALSE(agrees(both, Plan{PolicyId::aes_right, std::nullopt}));
  EXPECT_TRUE(agrees(DriverRow{}, std::nullopt));
}

TEST(Suite, PlaysWithNoiseUnlessItIsExact) {
  const sim::Scenario scenario = standing_car(19.0, 60.0);
  EXPECT_EQ(as_played(scenario, {.methods = {"aeb"}, .exact = true}).perception,
            sim::PerceptionModel{});
  EXPECT_EQ(as_played(scenario, {.methods = {"aeb"}}).perception, usual_perception());
  sim::Scenario own = scenario;
  own.perception.latency = 0.3;
  EXPECT_EQ(as_played(own, {.methods = {"aeb"}}).perception, own.perception);
  EXPECT_NE(encounter_seed(1, 2), encounter_seed(2, 1));
}

}  // namespace
}  // namespace saca::eval::suite_test
