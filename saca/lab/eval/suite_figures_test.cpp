#include "saca/lab/eval/suite_figures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace saca::eval::suite_figures_test {
namespace {

using manoeuvre::PolicyId;

/// A row in which methods suffered so much, the first being AEB.
SuiteRow made(std::uint64_t number, const std::vector<double>& harms, double best,
              bool quiet = false) {
  SuiteRow row{
      .number = number, .family = "made", .fault = {}, .risk = {}, .twin = {}, .driver = {}};
  row.risk.best_harm = best;
  row.risk.published_best_harm = best;
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
  std::vector<const SuiteRow*> all(rows.size());
  std::transform(rows.begin(), rows.end(), all.begin(), [](const SuiteRow& row) { return &row; });
  return suite_figures(all, methods, 0, 1);
}

TEST(SuiteFigures, AreMeansOverTheEncounters) {
  std::vector<SuiteRow> rows{made(0, {0.3, 0.1}, 0.1), made(1, {0.1, 0.106}, 0.0),
                             made(2, {0.0, 0.0049}, 0.0, true), made(3, {0.2, 0.0}, 0.05)};
  rows[0].risk.published_best_harm = 0.15;
  const auto told = figures(rows, {"aeb", "other"});
  EXPECT_NEAR(told[0].harm.value, 0.6 / 4.0, 1e-12);
  EXPECT_NEAR(told[0].regret.value, (0.2 + 0.1 + 0.0 + 0.15) / 4.0, 1e-12);
  // Of the eight policies the best harms 0.05 more in the first, and as much in the others.
  EXPECT_NEAR(told[0].published_regret.value, (0.15 + 0.1 + 0.0 + 0.15) / 4.0, 1e-12);
  EXPECT_NEAR(told[1].over_aeb.value, (-0.2 + 0.006 + 0.0049 - 0.2) / 4.0, 1e-12);
  EXPECT_EQ(told[1].worse_than_aeb.value, 0.25);  // 0.006 is material, 0.0049 is not
  EXPECT_EQ(told[0].over_aeb.value, 0.0);
  EXPECT_EQ(told[1].right.value, 0.5);  // the first, and the last, which acted better than at T1
  EXPECT_EQ(told[1].needless.value, 1.0);
  EXPECT_EQ(told[1].needless.n, 1);
  EXPECT_FALSE(told[1].twins.has_value());
  EXPECT_LE(told[0].harm.low, told[0].harm.value);
  EXPECT_GE(told[0].harm.high, told[0].harm.value);
}

// Two of three encounters have a twin: one in which the second acts and harms, one in which nobody
// acts.
TEST(SuiteFigures, TellWhatIsDoneInTwins) {
  std::vector<SuiteRow> rows{made(0, {0.0, 0.0}, 0.0), made(1, {0.0, 0.0}, 0.0),
                             made(2, {0.0, 0.0}, 0.0)};
  rows[0].twin = made(0, {0.0, 0.3}, 0.0).risk;
  rows[1].twin = made(1, {0.0, 0.0}, 0.0).risk;
  for (MethodRun& run : rows[1].twin->runs) {
    run.acted_at.reset();
    run.plan = manoeuvre::doing_nothing;
  }
  const auto told = figures(rows, {"aeb", "other"});
  EXPECT_EQ(told[1].twins.value().harm.n, 2);
  EXPECT_NEAR(told[1].twins.value().harm.value, 0.15, 1e-12);
  EXPECT_EQ(told[0].twins.value().harm.value, 0.0);
  EXPECT_EQ(told[1].twins.value().false_triggers.value, 0.5);
  EXPECT_FALSE(figures({rows[2]}, {"aeb", "other"})[1].twins.has_value());
}

TEST(SuiteFigures, SumWhatWasThought) {
  std::vector<SuiteRow> rows{made(0, {0.0, 0.0}, 0.0), made(1, {0.0, 0.0}, 0.0)};
  rows[0].risk.runs[1].thinking = encounter::ThinkingFigures{.forecasts = 3, .recalled = 2};
  rows[1].risk.runs[1].thinking = encounter::ThinkingFigures{.forecasts = 1, .answered = 1};
  const auto told = figures(rows, {"aeb", "saca"});
  EXPECT_EQ(told[0].thinking, std::nullopt);
  EXPECT_EQ(told[1].thinking,
            (encounter::ThinkingFigures{.forecasts = 4, .recalled = 2, .answered = 1}));
}

// Decided by a verdict at T1: 0.1 expected of a drift that harms 0.4 in truth, braking 0.3 for 0.2;
// of a swerve to 5 m/s 0.5, which the tried one to 4 m/s is most like. One decided later, one by no
// verdict: they do not count.
TEST(SuiteFigures, HoldWhatWasExpectedAgainstWhatHappened) {
  const auto drift = manoeuvre::Plan{PolicyId::t_drift_left, std::nullopt};
  const auto swerve = manoeuvre::Plan{PolicyId::es_b_left, 5.0};
  std::vector<SuiteRow> rows(4, made(0, {0.0, 0.0}, 0.0));
  for (SuiteRow& row : rows) {
    row.risk.trigger = 2.0;
    row.risk.tried = {{manoeuvre::full_braking, 0.2, true},
                      {{PolicyId::es_b_left, 0.0}, 0.9, true},
                      {{PolicyId::es_b_left, 4.0}, 0.6, true},
                      {drift, 0.4, true}};
    row.risk.runs[1].thinking.emplace();
  }
  rows[0].risk.runs[1].thinking->expected = {2.0, drift, 0.1, 0.3, 1};
  rows[1].risk.runs[1].thinking->expected = {2.0, swerve, 0.5, 0.3, 2};
  rows[2].risk.runs[1].thinking->expected = {2.5, drift, 0.7, 0.7, 3};
  const auto told = figures(rows, {"aeb", "saca"});
  EXPECT_FALSE(told[0].expected.has_value());
  const ExpectedFigures& saca = told[1].expected.value();
  EXPECT_EQ(saca.expected.n, 2);
  EXPECT_NEAR(saca.expected.value, 0.5 * (0.1 + 0.5), 1e-12);
  EXPECT_NEAR(saca.happened.value, 0.5 * (0.4 + 0.6), 1e-12);
  EXPECT_NEAR(saca.braking_expected.value, 0.3, 1e-12);
  EXPECT_EQ(saca.several.n, 3);
  EXPECT_NEAR(saca.several.value, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(saca.braking_happened.value, 0.2, 1e-12);
  EXPECT_EQ(saca.knowingly_worse.value, 0.5);
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

}  // namespace
}  // namespace saca::eval::suite_figures_test
