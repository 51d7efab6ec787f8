#include "saca/lab/encounter/intentions_seen.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"

namespace saca::encounter::intentions_seen_test {
namespace {

using world::ActorKind;

world::Scene with(double time, std::initializer_list<ActorKind> kinds) {
  world::Scene scene;
  scene.time = time;
  for (const ActorKind kind : kinds) {
    scene.actors.push_back({.id = 1, .kind = kind});
  }
  return scene;
}

intent::Beliefs beliefs(std::initializer_list<double> of_maintaining) {
  intent::Beliefs all;
  for (const double p : of_maintaining) {
    all.push_back({});
    all[all.size() - 1].at.fill({p, 0.0, 0.0, 1.0 - p});
  }
  return all;
}

TEST(IntentionsSeen, AreKeptByRoadUserInWhateverOrderTheyCome) {
  std::vector<IntentionsSeen> all;
  note(with(0.0, {ActorKind::car, ActorKind::truck}), beliefs({0.9, 0.5}), all);
  note(with(0.1, {ActorKind::truck}), beliefs({0.4}), all);
  note(with(0.2, {ActorKind::truck, ActorKind::car}), beliefs({0.3, 0.8}), all);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].kind, ActorKind::car);
  EXPECT_EQ(all[0].times, (std::vector<double>{0.0, 0.2}));
  EXPECT_EQ(all[0].beliefs[1].now()[0], 0.8);
  EXPECT_EQ(all[1].times, (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(all[1].beliefs[2].now()[0], 0.3);
}

TEST(IntentionsSeen, ObstaclesIntendNothing) {
  std::vector<IntentionsSeen> all;
  note(with(0.0, {ActorKind::obstacle, ActorKind::pedestrian}), beliefs({1.0, 0.7}), all);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, ActorKind::pedestrian);
  EXPECT_EQ(all[0].beliefs[0].now()[0], 0.7);
}

TEST(IntentionsSeen, RefuseBeliefsAboutOthers) {
  std::vector<IntentionsSeen> all;
  EXPECT_THROW(note(with(0.0, {ActorKind::car}), {}, all), ContractViolation);
}

}  // namespace
}  // namespace saca::encounter::intentions_seen_test
