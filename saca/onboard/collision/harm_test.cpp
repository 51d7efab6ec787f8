#include "saca/onboard/collision/harm.h"

#include <gtest/gtest.h>

#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/prepare/harm_file.h"

namespace saca::collision::harm_test {
namespace {

using world::ActorKind;

HarmModel shipped() {
  return prepare::read_harm("data/harm.toml").value();
}

// The published curve at 0, 10 and 25 m/s by hand: logits -4.457, -2.687 and -0.032.
TEST(ShippedHarm, HasThePublishedOccupantCurve) {
  const HarmModel model = shipped();
  EXPECT_NEAR(probability(model.occupant, 0.0), 0.011464, 1e-6);
  EXPECT_NEAR(probability(model.occupant, 10.0), 0.063745, 1e-6);
  EXPECT_NEAR(probability(model.occupant, 25.0), 0.492001, 1e-6);
  EXPECT_EQ(model.side, 0.244);
  EXPECT_EQ(model.rear, -0.431);
}

// Rosen and Sander, 2009: "the fatality risk at 50 km/h being more than twice as high as the risk
// at 40 km/h and more than five times higher than the risk at 30 km/h".
TEST(ShippedHarm, HasThePublishedPedestrianFatalityCurve) {
  const RiskCurve killed = shipped().pedestrian.killed;
  const auto at = [&](double kmh) { return probability(killed, from_kmh(kmh)); };
  EXPECT_NEAR(at(50.0), 1.0 / (1.0 + std::exp(6.9 - 4.5)), 1e-12);
  EXPECT_NEAR(at(6.9 / 0.090), 0.5, 1e-12);
  EXPECT_GT(at(50.0), 2.0 * at(40.0));
  EXPECT_GT(at(50.0), 5.0 * at(30.0));
}

// Lubbe, Wu, Jeppsson, 2022: 10 % at 29, 44 and 48 km/h.
TEST(ShippedHarm, HasTheSevereRisksOfItsSource) {
  const HarmModel model = shipped();
  EXPECT_NEAR(probability(model.pedestrian.severe, from_kmh(29.0)), 0.1, 1e-4);
  EXPECT_NEAR(probability(model.cyclist.severe, from_kmh(44.0)), 0.1, 1e-4);
  EXPECT_NEAR(probability(model.motorcyclist.severe, from_kmh(48.0)), 0.1, 1e-4);
}

TEST(ShippedHarm, CountsPeopleByKind) {
  const HarmModel model = shipped();
  EXPECT_EQ(model.people[static_cast<std::size_t>(ActorKind::car)], 1.5);
  EXPECT_EQ(model.people[static_cast<std::size_t>(ActorKind::pedestrian)], 1.0);
  EXPECT_EQ(model.people[static_cast<std::size_t>(ActorKind::obstacle)], 0.0);
}

TEST(Attributable, RisesFromNothingToCertainty) {
  const RiskCurve curve{-3.0, 0.5};
  EXPECT_EQ(attributable(curve, 0.0), 0.0);
  EXPECT_NEAR(attributable(curve, 1e3), 1.0, 1e-12);
  // At x = 6 P = 1/2; P(0) = 1 / (1 + e^3) = 0.0474259.
  EXPECT_NEAR(attributable(curve, 6.0), (0.5 - 0.0474259) / (1.0 - 0.0474259), 1e-7);
}

// By hand for 10 m/s in front: (0.063745 - 0.011464) / 0.988536 = 0.052887 severe, of whom 16 %
// count four more: times 1.64.
TEST(OccupantHarm, MatchesTheHandComputedCase) {
  EXPECT_NEAR(occupant_harm(shipped(), Face::front, 10.0), 0.052887 * 1.64, 2e-6);
}

TEST(OccupantHarm, IsWorstAtTheSideMildestAtTheRearAndGrowsWithSpeed) {
  const HarmModel model = shipped();
  for (double dv = 1.0; dv < 30.0; dv += 1.0) {
    EXPECT_GT(occupant_harm(model, Face::left, dv), occupant_harm(model, Face::front, dv));
    EXPECT_GT(occupant_harm(model, Face::front, dv), occupant_harm(model, Face::rear, dv));
    EXPECT_EQ(occupant_harm(model, Face::left, dv), occupant_harm(model, Face::right, dv));
    EXPECT_GT(occupant_harm(model, Face::front, dv), occupant_harm(model, Face::front, dv - 1.0));
  }
  EXPECT_EQ(occupant_harm(model, Face::left, 0.0), 0.0);
}

TEST(UnprotectedHarm, IsAboveThatOfAnOccupantAtTheSameSpeed) {
  const HarmModel model = shipped();
  for (const double v : {5.0, 10.0, 15.0, 20.0}) {
    EXPECT_GT(unprotected_harm(model, ActorKind::pedestrian, v),
              unprotected_harm(model, ActorKind::bicycle, v));
    EXPECT_GE(unprotected_harm(model, ActorKind::bicycle, v),
              unprotected_harm(model, ActorKind::motorcycle, v));
    EXPECT_GE(unprotected_harm(model, ActorKind::motorcycle, v),
              occupant_harm(model, Face::left, v));
  }
  EXPECT_EQ(unprotected_harm(model, ActorKind::pedestrian, 0.0), 0.0);
}

// By hand for a pedestrian at 10 m/s = 36 km/h: severe logit -1.567, at rest -4.807; killed -3.66,
// at rest -6.9: (0.172644 - 0.008106) / 0.991894 + 4 (0.025087 - 0.001007) / 0.998993.
TEST(UnprotectedHarm, MatchesTheHandComputedCase) {
  EXPECT_NEAR(unprotected_harm(shipped(), ActorKind::pedestrian, 10.0), 0.165883 + 4.0 * 0.024104,
              1e-5);
}

TEST(UnprotectedHarm, RefusesOccupantsAndWhatIsNoSpeed) {
  const HarmModel model = shipped();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)unprotected_harm(model, ActorKind::car, 5.0), ContractViolation);
  EXPECT_THROW((void)unprotected_harm(model, ActorKind::pedestrian, -1.0), ContractViolation);
  EXPECT_THROW((void)occupant_harm(model, Face::front, nan), ContractViolation);
  EXPECT_FALSE(unprotected(ActorKind::obstacle));
  EXPECT_TRUE(unprotected(ActorKind::motorcycle));
}

}  // namespace
}  // namespace saca::collision::harm_test
