#include "saca/lab/eval/cue_forecast.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saca::eval::cue_forecast_test {
namespace {

using world::CueKind;

DrawnCues one(CueKind kind, bool comes) {
  return {{kind, comes}};
}

/// `came` of `count` encounters with one cue of this kind.
void add(std::vector<DrawnCues>& to, CueKind kind, int came, int count) {
  for (int k = 0; k < count; ++k) {
    to.push_back(one(kind, k < came));
  }
}

intent::CueLaw law_of(double vans, double works) {
  intent::CueLaw law;
  law.unseen[static_cast<std::size_t>(CueKind::parked_vans)] =
      intent::Unseen{.who = world::ActorKind::pedestrian, .probability = vans};
  law.unseen[static_cast<std::size_t>(CueKind::work_zone)] =
      intent::Unseen{.who = world::ActorKind::pedestrian, .probability = works};
  return law;
}

TEST(CueForecast, CountsByKind) {
  std::vector<DrawnCues> encounters;
  add(encounters, CueKind::parked_vans, 1, 4);
  encounters.push_back({{CueKind::parked_vans, false}, {CueKind::work_zone, true}});
  const CueCounts counts = count_cues(encounters);
  EXPECT_EQ(counts[static_cast<std::size_t>(CueKind::parked_vans)].there, 5);
  EXPECT_EQ(counts[static_cast<std::size_t>(CueKind::parked_vans)].came, 1);
  EXPECT_DOUBLE_EQ(counts[static_cast<std::size_t>(CueKind::parked_vans)].probability(), 1.5 / 6.0);
  EXPECT_EQ(counts[static_cast<std::size_t>(CueKind::work_zone)].came, 1);
  EXPECT_DOUBLE_EQ(counts[static_cast<std::size_t>(CueKind::low_sun)].probability(), 0.5);
}

// 100 of 1000 behind vans, 500 of 1000 at works. What is expected of a forecast p of a share q is
// -q ln p - (1 - q) ln(1 - p).
TEST(CueForecast, LossesAreThoseOfTheirProbabilities) {
  std::vector<DrawnCues> encounters;
  add(encounters, CueKind::parked_vans, 100, 1000);
  add(encounters, CueKind::work_zone, 500, 1000);
  const auto loss = [](double q, double p) { return -q * std::log(p) - (1 - q) * std::log(1 - p); };
  const auto brier = [](double q, double p) { return q * (1 - p) * (1 - p) + (1 - q) * p * p; };
  const auto all = cue_forecasts(encounters, encounters, law_of(0.1, 0.5), 1);
  ASSERT_EQ(all.size(), 4U);
  const double base = 600.5 / 2001.0;
  EXPECT_EQ(all[0].key, "base_rate");
  EXPECT_NEAR(all[0].log_loss.value, 0.5 * (loss(0.1, base) + loss(0.5, base)), 1e-12);
  EXPECT_NEAR(all[0].brier.value, 0.5 * (brier(0.1, base) + brier(0.5, base)), 1e-12);
  EXPECT_EQ(all[1].key, "table");
  EXPECT_NEAR(all[1].log_loss.value, 0.5 * (loss(0.1, 100.5 / 1001.0) + loss(0.5, 500.5 / 1001.0)),
              1e-12);
  // One cue each: the regression tells the shares of both, but for the prior, which weighs as one
  // encounter of 1000 does.
  EXPECT_EQ(all[2].key, "logistic");
  EXPECT_NEAR(all[2].log_loss.value, 0.5 * (loss(0.1, 0.1) + loss(0.5, 0.5)), 1e-4);
  EXPECT_EQ(all[3].key, "law");
  EXPECT_NEAR(all[3].log_loss.value, 0.5 * (loss(0.1, 0.1) + loss(0.5, 0.5)), 1e-12);
  EXPECT_NEAR(all[3].brier.value, 0.5 * (brier(0.1, 0.1) + brier(0.5, 0.5)), 1e-12);
}

// Two cues that know nothing of each other: 1 - 0.9 * 0.5.
TEST(CueForecast, OfTwoCuesOneIsEnough) {
  const std::vector<DrawnCues> both{{{CueKind::parked_vans, true}, {CueKind::work_zone, false}}};
  const auto all = cue_forecasts({}, both, law_of(0.1, 0.5), 1);
  EXPECT_NEAR(all[3].log_loss.value, -std::log(1.0 - 0.9 * 0.5), 1e-12);
}

// Of a kind that was never counted the table says what all who may come together say: leaves, which
// bring nobody, are not among them.
TEST(CueForecast, AnotherKindIsTakenForAllWhoMayCome) {
  std::vector<DrawnCues> learnt;
  add(learnt, CueKind::parked_vans, 100, 1000);
  add(learnt, CueKind::work_zone, 500, 1000);
  add(learnt, CueKind::wet_leaves, 900, 1000);
  intent::CueLaw law = law_of(0.1, 0.5);
  law.unseen[static_cast<std::size_t>(CueKind::low_sun)] =
      intent::Unseen{.who = world::ActorKind::pedestrian, .probability = 0.7};
  law.unseen[static_cast<std::size_t>(CueKind::wet_leaves)] =
      intent::Unseen{.probability = 0.9, .grip_share = 0.5};
  const auto all =
      cue_forecasts(learnt, std::vector<DrawnCues>{one(CueKind::low_sun, true)}, law, 1);
  EXPECT_NEAR(all[1].log_loss.value, -std::log(600.5 / 2001.0), 1e-12);
  EXPECT_TRUE(std::isfinite(all[2].log_loss.value));
  const intent::CueLaw counted = counted_law(law, count_cues(learnt));
  EXPECT_DOUBLE_EQ(counted.of(CueKind::low_sun)->probability, 600.5 / 2001.0);
  EXPECT_DOUBLE_EQ(counted.of(CueKind::wet_leaves)->probability, 900.5 / 1001.0);
  EXPECT_EQ(counted.of(CueKind::low_sun)->who, world::ActorKind::pedestrian);
  EXPECT_FALSE(counted.of(CueKind::school_zone).has_value());
}

// Nothing ever comes: no weight runs away.
TEST(CueForecast, StaysFiniteWhereNothingComes) {
  std::vector<DrawnCues> never;
  add(never, CueKind::parked_vans, 0, 50);
  const auto all = cue_forecasts(never, never, law_of(0.01, 0.5), 1);
  for (const CueForecast& each : all) {
    EXPECT_TRUE(std::isfinite(each.log_loss.value)) << each.key;
    EXPECT_LT(each.log_loss.value, 0.1) << each.key;
  }
}

}  // namespace
}  // namespace saca::eval::cue_forecast_test
