#include "saca/lab/scenario/chance.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace saca::scenario::chance_test {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;
using testing::Lt;

TEST(Chance, NothingIsLeftToItUnlessDrawn) {
  const Chance none;
  EXPECT_EQ(none.car.mass, 1.0);
  EXPECT_EQ(none.actors[3].speed, 1.0);
  EXPECT_FALSE(none.actors[3].choice.has_value());
}

TEST(Chance, TheSameNumbersGiveTheSameDraw) {
  const Chance a = draw_chance(7, 3, 1.5);
  const Chance b = draw_chance(7, 3, 1.5);
  EXPECT_EQ(a.car.grip, b.car.grip);
  EXPECT_EQ(a.perception, b.perception);
  EXPECT_EQ(a.actors[5].ahead, b.actors[5].ahead);
  EXPECT_EQ(a.from, 1.5);
}

TEST(Chance, NeighbouringSeedsAndNumbersHaveNothingInCommon) {
  const Chance a = draw_chance(7, 3, 0.0);
  for (const Chance& other : {draw_chance(8, 3, 0.0), draw_chance(7, 4, 0.0),
                              draw_chance(3, 7, 0.0), draw_chance(7ULL << 32U, 3, 0.0)}) {
    EXPECT_NE(a.car.grip, other.car.grip);
    EXPECT_NE(a.actors[0].speed, other.actors[0].speed);
  }
}

// 4000 draws: the standard error of a mean is sd / 63, of an sd 1.1 % of it; bounds of four of
// them. Cutting at three sd takes 1.3 % off the sd.
TEST(Chance, DrawsHaveTheStatedSpread) {
  constexpr int n = 4000;
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < n; ++k) {
    const ActorChance actor = draw_chance(1, static_cast<std::uint64_t>(k), 0.0).actors[2];
    sum += actor.speed - 1.0;
    squares += (actor.speed - 1.0) * (actor.speed - 1.0);
    EXPECT_THAT(actor.ahead, AllOf(Ge(-3.0 * actor_sd.ahead), Le(3.0 * actor_sd.ahead)));
    EXPECT_THAT(actor.choice.value(), AllOf(Ge(0.0), Lt(1.0)));
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 * actor_sd.speed / 63.0);
  EXPECT_NEAR(std::sqrt(squares / n), 0.987 * actor_sd.speed, 0.045 * actor_sd.speed);
}

TEST(Chance, ActorsAreDrawnApartFromEachOther) {
  constexpr int n = 4000;
  double product = 0.0;
  for (int k = 0; k < n; ++k) {
    const Chance chance = draw_chance(2, static_cast<std::uint64_t>(k), 0.0);
    product += chance.actors[0].ahead * chance.actors[1].ahead;
  }
  const double correlation = product / n / (actor_sd.ahead * actor_sd.ahead);
  EXPECT_NEAR(correlation, 0.0, 4.0 / std::sqrt(n));
}

TEST(Chance, RefusesATimeBeforeTheStart) {
  EXPECT_THROW((void)draw_chance(1, 1, -0.1), ContractViolation);
  EXPECT_THROW((void)draw_chance(1, 1, std::nan("")), ContractViolation);
}

}  // namespace
}  // namespace saca::scenario::chance_test
