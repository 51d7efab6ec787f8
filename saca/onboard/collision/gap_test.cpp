#include "saca/onboard/collision/gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace saca::collision::gap_test {
namespace {

using world::Footprint;
using world::Shape;

struct Two {
  Footprint a;
  Footprint b;
  Pose X_WA;
  Pose X_WB;
};
Two random_two(std::mt19937_64& rng, Shape of_b) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  return {{.length = 4.5 + u(rng), .width = 1.8, .centre_x = 0.4 * u(rng)},
          {of_b, 3.0 + 2.0 * u(rng), 1.5 + u(rng), 0.3 * u(rng)},
          {{u(rng), u(rng)}, 4.0 * u(rng)},
          {{7.0 * u(rng), 7.0 * u(rng)}, 4.0 * u(rng)}};
}

// Against the exact distance: never more, 0 or less exactly for boxes that overlap, and the same
// where a face is nearest.
TEST(Gap, OfBoxesIsTheDistanceAcrossAFace) {
  std::mt19937_64 rng(1);
  int faces = 0;
  for (int i = 0; i < 2000; ++i) {
    const Two two = random_two(rng, Shape::box);
    const Gap gap = gap_between(body_at(two.a, two.X_WA), body_at(two.b, two.X_WB));
    const double distance = separation(two.a, two.X_WA, two.b, two.X_WB).distance;
    EXPECT_NEAR(norm(gap.n), 1.0, 1e-12);
    if (distance == 0.0) {
      EXPECT_LE(gap.size, 1e-9);
      continue;
    }
    EXPECT_GT(gap.size, 0.0);
    EXPECT_LE(gap.size, distance + 1e-9);
    faces += gap.size > distance - 1e-9 ? 1 : 0;
  }
  EXPECT_GT(faces, 200);
}

TEST(Gap, OfWhatIsRoundIsNeverMoreThanTheDistance) {
  std::mt19937_64 rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Two two = random_two(rng, Shape::ellipse);
    const Gap gap = gap_between(body_at(two.a, two.X_WA), body_at(two.b, two.X_WB));
    const double distance = separation(two.a, two.X_WA, two.b, two.X_WB).distance;
    EXPECT_LE(gap.size, distance + 1e-6);
    // The directions looked along include those of both axes: a right angle apart.
    EXPECT_GE(gap.size, distance > 0.0 ? std::sqrt(0.5) * distance - 0.5 * two.b.length : -10.0);
  }
  // A disc before a corner: the distance to the corner less the radius.
  const Footprint box{.length = 4.0, .width = 2.0};
  const Footprint disc{Shape::ellipse, 1.0, 1.0, 0.0};
  const Gap gap = gap_between(body_at(box, {}), body_at(disc, {{5.0, 5.0}, 0.3}));
  EXPECT_NEAR(gap.size, 5.0 - 0.5, 1e-12);
  EXPECT_NEAR(gap.n.x, 0.6, 1e-12);
}

TEST(Gap, OfWhatIsNoNumberHasNoEnd) {
  const Footprint box{.length = 4.0, .width = 2.0};
  const double nan = std::nan("");
  EXPECT_EQ(gap_between(body_at(box, {}), body_at(box, {{nan, nan}, nan})).size,
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace saca::collision::gap_test
