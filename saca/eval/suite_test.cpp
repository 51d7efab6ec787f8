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

/// A row in which methods suffered so much, the first being AEB.
SuiteRow made(std::uint64_t number, std::vector<double> harms, double best, bool quiet = false) {
  SuiteRow row{
      .number = number, .family = "made", .fault = {}, .risk = {}, .twin = {}, .driver = {}};
  row.risk.best_harm = best;
  row.risk.tried = {{{PolicyId::no_intervention, std::nullopt}, quiet ? 0.0 : 1.0, !quiet}};
  for (const double harm : harms) {
    MethodRun run;
    run.harm = harm;
    run.acted_at = 1.0;
    run.plan = manoeuvre::Plan{PolicyId::aeb, std::nullopt};
    row.risk.runs.push_back(run);
  }
  return row;
}

std::vector<MethodFigures> figures(const std::vector<SuiteRow>& rows,
                                   const std::vector<std::string>& methods) {
  std::vector<const SuiteRow*> all;
  for (const SuiteRow& row : rows) {
    all.push_back(&row);
  }
  return suite_figures(all, methods, 0, 1);
}

TEST(SuiteFigures, AreMeansOverTheEncounters) {
  const std::vector<SuiteRow> rows{made(0, {0.3, 0.1}, 0.1), made(1, {0.1, 0.106}, 0.0),
                                   made(2, {0.0, 0.0049}, 0.0, true), made(3, {0.2, 0.0}, 0.05)};
  const auto told = figures(rows, {"aeb", "other"});
  EXPECT_NEAR(told[0].harm.value, 0.6 / 4.0, 1e-12);
  EXPECT_NEAR(told[0].regret.value, (0.2 + 0.1 + 0.0 + 0.15) / 4.0, 1e-12);
  EXPECT_NEAR(told[1].over_aeb.value, (-0.2 + 0.006 + 0.0049 - 0.2) / 4.0, 1e-12);
  EXPECT_EQ(told[1].worse_than_aeb.value, 0.25);  // 0.006 is material, 0.0049 is not
  EXPECT_EQ(told[0].over_aeb.value, 0.0);
  EXPECT_EQ(told[1].right.value, 0.5);  // the first, and the last, which acted better than at T1
  EXPECT_EQ(told[1].needless.value, 1.0);
  EXPECT_EQ(told[1].needless.n, 1);
  EXPECT_FALSE(told[1].false_triggers.has_value());
  EXPECT_LE(told[0].harm.low, told[0].harm.value);
  EXPECT_GE(told[0].harm.high, told[0].harm.value);
}

// 400 encounters of variance 1/12: the standard error is 0.0144, 1.96 of it 0.0283; the bootstrap's
// 1,000 samples know their ends to some 6 %.
TEST(SuiteFigures, IntervalsAreAsWideAsTheoryHasThem) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> even;
  std::vector<SuiteRow> rows;
  for (std::uint64_t i = 0; i < 400; ++i) {
    rows.push_back(made(i, {even(rng)}, 0.0));
  }
  const Estimate harm = figures(rows, {"aeb"})[0].harm;
  EXPECT_NEAR(harm.high - harm.low, 2.0 * 1.96 * std::sqrt(1.0 / 12.0 / 400.0), 0.008);
  const Estimate again = figures(rows, {"aeb"})[0].harm;
  EXPECT_EQ(harm.low, again.low);
}

// Two methods that differ by the same in every encounter: the paired interval has no width.
TEST(SuiteFigures, PairedDifferencesLoseWhatBothSuffer) {
  std::mt19937_64 rng(6);
  std::uniform_real_distribution<double> even;
  std::vector<SuiteRow> rows;
  for (std::uint64_t i = 0; i < 50; ++i) {
    const double harm = even(rng);
    rows.push_back(made(i, {harm, harm + 0.25}, 0.0));
  }
  const Estimate more = figures(rows, {"aeb", "other"})[1].over_aeb;
  EXPECT_NEAR(more.low, 0.25, 1e-12);
  EXPECT_NEAR(more.high, 0.25, 1e-12);
  const Estimate less = harm_above(rows, 0, 1, 1);
  EXPECT_NEAR(less.value, -0.25, 1e-12);
  EXPECT_NEAR(less.low, -0.25, 1e-12);
}

TEST(SuiteFigures, RowsWithAFaultAreLeftOut) {
  std::vector<SuiteRow> rows{made(0, {0.5}, 0.0), made(1, {0.1}, 0.0)};
  rows[0].fault = "broken";
  EXPECT_EQ(figures(rows, {"aeb"})[0].harm.value, 0.1);
  rows[1].fault = "broken";
  EXPECT_TRUE(figures(rows, {"aeb"}).empty());
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

// Paper, section V: moderate manoeuvres cost 0.5, drifts 1.
TEST(SuiteFigures, FalseTriggersCostWhatThePaperSays) {
  MethodRun run;
  EXPECT_EQ(false_trigger_loss(run), 0.0);
  run.acted_at = 1.0;
  for (const PolicyId policy : manoeuvre::all_policies) {
    run.plan = manoeuvre::Plan{policy, std::nullopt};
    if (policy != PolicyId::no_intervention) {
      EXPECT_EQ(false_trigger_loss(run), manoeuvre::drifts(policy) ? 1.0 : 0.5);
    }
  }
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
