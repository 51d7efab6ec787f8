#include "saca/base/world/usual_body.h"

#include <gtest/gtest.h>

namespace saca::world {
namespace {

// Euro NCAP, Global Vehicle Target: 4.02 x 1.71 m; its adult pedestrian target is 0.5 m wide.
TEST(UsualBody, HasTheSizesOfTheTestTargets) {
  EXPECT_DOUBLE_EQ(usual_body(ActorKind::car).footprint.length, 4.02);
  EXPECT_DOUBLE_EQ(usual_body(ActorKind::car).footprint.width, 1.71);
  EXPECT_DOUBLE_EQ(usual_body(ActorKind::pedestrian).footprint.width, 0.5);
}

TEST(UsualBody, MakesAnActorOfEachKind) {
  for (const ActorKind kind :
       {ActorKind::car, ActorKind::van, ActorKind::truck, ActorKind::motorcycle, ActorKind::bicycle,
        ActorKind::pedestrian, ActorKind::obstacle}) {
    const UsualBody body = usual_body(kind);
    EXPECT_FALSE(
        broken_rule(Actor{.id = 1, .kind = kind, .footprint = body.footprint, .mass = body.mass}));
  }
}

}  // namespace
}  // namespace saca::world
