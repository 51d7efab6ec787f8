#include "saca/lab/families/family_cues.h"

#include <gmock/gmock.h>

#include <cmath>

#include "saca/lab/scenario/motion.h"

namespace saca::families::family_cues_test {
namespace {

using world::ActorKind;
using world::CueKind;

class FamilyCuesTest : public testing::Test {
 protected:
  static FamilyCues cues_of(std::vector<CueKind> kinds, double probability) {
    FamilyCues cues{intent::load_cue_law("scenarios/families/cues.toml").value(), std::move(kinds)};
    for (auto& unseen : cues.law.unseen) {
      unseen->probability = probability;
    }
    return cues;
  }
  static Family family(const FamilyCues& cues) {
    Family family = load_family("scenarios/families", "one_way").value();
    family.cues = cues;
    return family;
  }
  static FamilySample drawn(const Family& family, std::uint64_t number) {
    auto one = sample(family, 1, number, "compact_rwd_ev", scenario::standard_ego);
    EXPECT_TRUE(one.has_value());
    return std::move(one).value();
  }
};

// 2000 draws with probability 0.3: four standard errors are 4 sqrt(0.3 * 0.7 / 2000) = 0.041.
TEST_F(FamilyCuesTest, WhatACueStandsForComesAsOftenAsTheLawSays) {
  std::mt19937_64 rng(7);
  const FamilyCues cues = cues_of({CueKind::bus_at_stop, CueKind::low_sun}, 0.3);
  int all = 0;
  int two = 0;
  int come = 0;
  while (all < 2000) {
    const auto drawn = draw_cues(cues, rng);
    two += drawn.size() == 2 ? 1 : 0;
    for (const DrawnCue& cue : drawn) {
      ++all;
      come += cue.comes ? 1 : 0;
    }
    ASSERT_TRUE(drawn.size() == 1 || drawn[0].kind != drawn[1].kind);
  }
  EXPECT_NEAR(come / 2000.0, 0.3, 0.041);
  EXPECT_NEAR(two / (2000.0 - two), 0.3, 0.047);
}

// Redrawn places do not make it rarer: 300 encounters, four standard errors.
TEST_F(FamilyCuesTest, SamplesKeepTheProbability) {
  const Family of_vans = family(cues_of({CueKind::parked_vans}, 0.5));
  int come = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    come += drawn(of_vans, number).cues.front().comes ? 1 : 0;
  }
  EXPECT_NEAR(come / 300.0, 0.5, 4.0 * std::sqrt(0.25 / 300.0));
}

TEST_F(FamilyCuesTest, WhoComesIsOnTheWayOfWhoGoesOn) {
  for (const CueKind kind : {CueKind::school_zone, CueKind::bus_at_stop, CueKind::low_sun}) {
    const FamilySample one = drawn(family(cues_of({kind}, 1.0)), 3);
    const world::Cue& cue = one.scenario.cues.front();
    const auto& start = std::get<scenario::EgoStart>(one.scenario.ego);
    const double there = (cue.p_W.x - 2.25) / start.speed;  // the front of the standard car
    bool met = false;
    for (std::size_t i = 0; i < one.scenario.actors.size(); ++i) {
      const auto* recording = std::get_if<scenario::Recording>(&one.scenario.actors[i].motion);
      if (recording == nullptr || one.scenario.actors[i].kind != ActorKind::pedestrian) {
        continue;
      }
      met = true;
      EXPECT_NEAR(recording->front().X_WA.p.x, cue.p_W.x, 1e-9);
      // Between the middle of our lane and its side's edge when the front is there.
      for (const scenario::Sample& sample : *recording) {
        if (std::abs(sample.time - there) < 0.05) {
          EXPECT_LE(std::abs(sample.X_WA.p.y), std::abs(cue.p_W.y) + 0.2);
          EXPECT_GE(sample.X_WA.p.y * cue.p_W.y, -0.2 * std::abs(cue.p_W.y));
        }
      }
    }
    EXPECT_TRUE(met) << name(kind);
  }
}

TEST_F(FamilyCuesTest, TheTwinHasTheCuesAndNobodyComes) {
  const FamilySample one = drawn(family(cues_of({CueKind::work_zone}, 1.0)), 5);
  const FamilySample none = drawn(family(cues_of({CueKind::work_zone}, 0.0)), 5);
  ASSERT_EQ(one.twin.cues.size(), 1U);
  EXPECT_EQ(one.twin.cues[0].kind, CueKind::work_zone);
  EXPECT_TRUE(one.cues.front().comes);
  EXPECT_FALSE(none.cues.front().comes);
  const auto people = [](const scenario::Scenario& scenario) {
    return std::count_if(scenario.actors.begin(), scenario.actors.end(),
                         [](const scenario::ScenarioActor& actor) {
                           return std::holds_alternative<scenario::Recording>(actor.motion);
                         });
  };
  EXPECT_EQ(people(one.scenario), 1);
  EXPECT_EQ(people(one.twin), 0);
  EXPECT_EQ(people(none.scenario), 0);
}

// Whether he comes is not told by the place: with the same dice all else is the same.
TEST_F(FamilyCuesTest, WhoDoesNotComeLeavesThePlaceAsItIs) {
  FamilyCues cues = cues_of({CueKind::parked_vans}, 1.0);
  const FamilySample comes = drawn(family(cues), 4);
  cues.law.unseen[static_cast<std::size_t>(CueKind::parked_vans)]->probability = 0.0;
  const FamilySample stays = drawn(family(cues), 4);
  EXPECT_EQ(scenario::write_scenario(comes.twin), scenario::write_scenario(stays.twin));
  EXPECT_EQ(comes.scenario.actors.size(), stays.scenario.actors.size() + 1);
}

TEST_F(FamilyCuesTest, NobodyBrakesHarderThanLeavesAllow) {
  Family brakes = load_family("scenarios/families", "lead_brakes").value();
  brakes.cues = cues_of({CueKind::wet_leaves}, 1.0);
  for (std::uint64_t number = 0; number < 20; ++number) {
    const FamilySample one = drawn(brakes, number);
    for (const scenario::ScenarioActor& actor : one.scenario.actors) {
      const auto* script = std::get_if<scenario::Script>(&actor.motion);
      if (script != nullptr && script->behaviour == scenario::Behaviour::brake) {
        EXPECT_LE(script->acceleration, 9.81 * one.scenario.grip + 1e-9);
      }
    }
  }
}

TEST_F(FamilyCuesTest, WhereItIsSlipperyTheEgoDoesNotKnow) {
  const FamilySample one = drawn(family(cues_of({CueKind::wet_leaves}, 1.0)), 2);
  EXPECT_NEAR(one.scenario.grip, 0.5 * believed_grip(one.scenario), 1e-12);
  EXPECT_FALSE(one.twin.perception.grip_believed);
  EXPECT_DOUBLE_EQ(one.twin.grip, scenario::believed_grip(one.scenario));
}

TEST_F(FamilyCuesTest, FamiliesWithoutCuesAreWhatTheyWere) {
  Family plain = load_family("scenarios/families", "one_way").value();
  EXPECT_TRUE(drawn(plain, 1).scenario.cues.empty());
}

}  // namespace
}  // namespace saca::families::family_cues_test
