#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "saca/base/world/footprint.h"
#include "saca/lab/families/family.h"
#include "saca/lab/scenario/motion.h"
#include "saca/lab/sim/line_of_sight.h"
#include "saca/lab/sim/traffic.h"

namespace saca::families::family_sample_test {
namespace {

using testing::HasSubstr;

Family shipped(FamilyKind kind) {
  return load_family("scenarios/families", name(kind)).value();
}

/// Smallest distance between the ego, going on, and anybody, over the whole scenario [m].
double least_distance(const scenario::Scenario& scenario) {
  sim::Traffic traffic(scenario);
  double least = 1e9;
  while (traffic.time() < scenario.duration) {
    const world::EgoState ego = scenario::ego_at(scenario, traffic.time());
    for (const world::Actor& actor : traffic.actors()) {
      least = std::min(
          least, world::separation(scenario::standard_ego, ego.X_WB, actor.footprint, actor.X_WA)
                     .distance);
    }
    traffic.advance(ego.X_WB, rotated(ego.v_B, ego.X_WB.yaw), scenario::standard_ego);
  }
  return least;
}

class EveryFamily : public testing::TestWithParam<FamilyKind> {};

TEST_P(EveryFamily, GivesScenariosThatAFileCanHold) {
  const Family family = shipped(GetParam());
  for (std::uint64_t number = 0; number < 4; ++number) {
    const auto drawn = sample(family, 3, number, "compact_rwd_ev", scenario::standard_ego);
    ASSERT_TRUE(drawn.has_value()) << drawn.error().message;
    for (const scenario::Scenario& scenario : {drawn.value().scenario, drawn.value().twin}) {
      const auto read = scenario::read_scenario(scenario::write_scenario(scenario), scenario.name);
      EXPECT_TRUE(read.has_value()) << read.error().message;
    }
  }
}

TEST_P(EveryFamily, SameNumbersSameBytes) {
  const Family family = shipped(GetParam());
  const auto draw = [&](std::uint64_t seed, std::uint64_t number) {
    return scenario::write_scenario(
        sample(family, seed, number, "compact_rwd_ev", scenario::standard_ego).value().scenario);
  };
  EXPECT_EQ(draw(3, 7), draw(3, 7));
  EXPECT_NE(draw(3, 7), draw(3, 8));
  EXPECT_NE(draw(3, 7), draw(4, 7));
}

// Whoever goes on is in danger, or nearly, most of the time; in the twin hardly ever.
TEST_P(EveryFamily, DangerIsInTheScenarioAndNotInItsTwin) {
  const Family family = shipped(GetParam());
  constexpr int count = 12;
  int dangerous = 0;
  int harmless = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    const FamilySample drawn =
        sample(family, 9, number, "compact_rwd_ev", scenario::standard_ego).value();
    dangerous += least_distance(drawn.scenario) < 1.0 ? 1 : 0;
    harmless += least_distance(drawn.twin) > 0.0 ? 1 : 0;
  }
  EXPECT_GE(dangerous, count / 2);
  EXPECT_GE(harmless, count - 3);
}

INSTANTIATE_TEST_SUITE_P(All, EveryFamily,
                         testing::Values(FamilyKind::crossing, FamilyKind::one_way,
                                         FamilyKind::lead_brakes, FamilyKind::cut_in,
                                         FamilyKind::cut_out, FamilyKind::pedestrian,
                                         FamilyKind::cyclist, FamilyKind::head_on,
                                         FamilyKind::merge, FamilyKind::dart_out,
                                         FamilyKind::slower_lead, FamilyKind::sideswipe,
                                         FamilyKind::turning),
                         [](const auto& one) { return std::string(name(one.param)); });

// Who only stands by stands beside our lane: half a metre at least from it.
TEST(FamilySample, BystandersStandBesideTheLane) {
  Family family = shipped(FamilyKind::crossing);
  family.ranges["bystander_share"] = {1.0, 1.0, "test"};
  int to_the_left = 0;
  for (std::uint64_t number = 0; number < 20; ++number) {
    const scenario::Scenario drawn =
        sample(family, 5, number, "compact_rwd_ev", scenario::standard_ego).value().scenario;
    const auto bystander = std::find_if(drawn.actors.begin(), drawn.actors.end(),
                                        [](const scenario::ScenarioActor& actor) {
                                          return actor.kind == world::ActorKind::pedestrian;
                                        });
    ASSERT_NE(bystander, drawn.actors.end());
    const double d = std::get<scenario::Script>(bystander->motion).start.d;
    EXPECT_GE(std::abs(d), 0.5 * drawn.road.lane_width + 0.5);
    to_the_left += d > 0.0 ? 1 : 0;
  }
  EXPECT_GT(to_the_left, 2);
  EXPECT_LT(to_the_left, 18);
}

// Who comes from between parked cars is hidden while there is time to think, and seen before he is
// struck.
TEST(FamilySample, WhoDartsOutIsMostlySeenAfterT1) {
  const Family family = shipped(FamilyKind::dart_out);
  constexpr double approach = 6.5;
  constexpr int count = 12;
  int seen_at_t1 = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    const scenario::Scenario drawn =
        sample(family, 5, number, "compact_rwd_ev", scenario::standard_ego).value().scenario;
    const auto is_seen = [&](double time) {
      sim::Traffic traffic(drawn);
      while (traffic.time() < time) {
        const world::EgoState state = scenario::ego_at(drawn, traffic.time());
        traffic.advance(state.X_WB, rotated(state.v_B, state.X_WB.yaw), scenario::standard_ego);
      }
      const auto actors = traffic.actors();
      return sim::in_sight(scenario::ego_at(drawn, time).X_WB, scenario::standard_ego, actors[0],
                           {actors.begin(), actors.size()});
    };
    EXPECT_FALSE(is_seen(approach - 4.0)) << number;
    EXPECT_TRUE(is_seen(approach - 0.1)) << number;
    seen_at_t1 += is_seen(approach - 1.3) ? 1 : 0;
  }
  EXPECT_LE(seen_at_t1, count / 2);
}

TEST(FamilySample, SaysWhenItsRangesGiveNoSensibleEncounter) {
  Family family = shipped(FamilyKind::lead_brakes);
  family.ranges["gap_s"] = {0.0, 0.0, "test"};  // bumpers touch from the start
  const auto drawn = sample(family, 1, 1, "compact_rwd_ev", scenario::standard_ego);
  ASSERT_FALSE(drawn.has_value());
  EXPECT_THAT(drawn.error().message, HasSubstr("narrow its ranges"));
}

}  // namespace
}  // namespace saca::families::family_sample_test
