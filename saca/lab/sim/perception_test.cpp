#include "saca/lab/sim/perception.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::sim::perception_test {
namespace {

using test::car;
using world::Actor;
using world::ActorKind;
using world::Scene;

constexpr double step = Perception::step;
constexpr double difference_time = 0.5;  // [s], of accelerations in a true scene

/// A truth in which everybody goes on at constant velocity and turning rate from time 0.
Scene truth_at(int look, const std::vector<Actor>& at_start) {
  Scene scene{.time = look * step, .ego_footprint = {world::Shape::box, 4.6, 1.8}};
  scene.ego_mass = 1'500.0;
  for (Actor actor : at_start) {
    const double w = actor.yaw_rate;
    const double t = scene.time;
    const Vec2 v = actor.v_W;
    if (w == 0.0) {
      actor.X_WA.p = actor.X_WA.p + t * v;
    } else {  // the circle's centre lies at v / w to the left
      const Vec2 centre = actor.X_WA.p + (1.0 / w) * Vec2{-v.y, v.x};
      actor.v_W = rotated(v, w * t);
      actor.X_WA.p = centre - (1.0 / w) * Vec2{-actor.v_W.y, actor.v_W.x};
      actor.X_WA.yaw = wrap_angle(actor.X_WA.yaw + w * t);
    }
    scene.actors.push_back(actor);
  }
  return scene;
}

std::vector<Actor> many(int count) {
  std::vector<Actor> cars;
  for (int i = 0; i < count; ++i) {
    cars.push_back(car(static_cast<std::uint8_t>(i + 1), {10.0 * (i / 4 + 1), 5.0 * (i % 4) - 7.0},
                       {10.0 + i, 0.5 * i}));
  }
  return cars;
}

/// Every number that a scene holds, as bits.
std::vector<std::uint64_t> bits(const Actor& a) {
  std::vector<std::uint64_t> all{a.id, static_cast<std::uint64_t>(a.kind),
                                 static_cast<std::uint64_t>(a.footprint.shape), a.occluded};
  for (const double x : {a.footprint.length, a.footprint.width, a.footprint.centre_x, a.mass,
                         a.X_WA.p.x, a.X_WA.p.y, a.X_WA.yaw, a.v_W.x, a.v_W.y, a.a_W.x, a.a_W.y,
                         a.yaw_rate, a.position_sd, a.velocity_sd, a.existence, a.age}) {
    all.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return all;
}
std::vector<std::uint64_t> bits(const Scene& s) {
  std::vector<std::uint64_t> all;
  for (const double x : {s.time, s.ego.X_WB.p.x, s.ego.X_WB.p.y, s.ego.X_WB.yaw, s.ego.v_B.x,
                         s.ego.v_B.y, s.ego.yaw_rate, s.ego.a_B.x, s.ego.a_B.y, s.ego_mass, s.grip,
                         s.grip_sd, s.road.left_edge, s.road.right_edge, s.road.curvature}) {
    all.push_back(std::bit_cast<std::uint64_t>(x));
  }
  for (const Actor& actor : s.actors) {
    const auto more = bits(actor);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

const Actor* find(const Scene& scene, const Actor& wanted) {
  for (const Actor& actor : scene.actors) {
    if (actor.kind == wanted.kind && actor.id == wanted.id) {
      return &actor;
    }
  }
  return nullptr;
}

const scenario::PerceptionModel noisy{.position_sd = 0.3,
                                      .velocity_sd = 0.4,
                                      .heading_sd = 0.02,
                                      .correlation_time = 0.2,
                                      .latency = 0.1,
                                      .dropout = 0.05,
                                      .range = 200.0,
                                      .occlusion = true,
                                      .confirmation = 0.1,
                                      .memory = 0.5,
                                      .grip_sd = 0.05};

TEST(Perception, PerfectIsTheTruthBitForBit) {
  Perception perception({}, 1);
  std::vector<Actor> actors = many(7);
  actors[2].v_W = {-0.0, 3.0};
  actors[3].a_W = {1.0, -0.0};
  actors[4].yaw_rate = 0.3;
  for (int k = 0; k < 50; ++k) {
    Scene truth = truth_at(k, actors);
    truth.grip = 0.37;
    truth.grip_sd = 0.01;
    EXPECT_EQ(bits(perception.look(truth)), bits(truth));
  }
}

// Pooled over actors, axes and looks, against the variances of sample moments of an AR(1) process.
struct Moments {
  double square = 0.0;
  double lagged = 0.0;
  int count = 0;
};

template <class Error>
Moments moments_of(const scenario::PerceptionModel& model, int lag, const Error& error) {
  Perception perception(model, 5);
  const std::vector<Actor> actors = many(32);
  std::vector<std::vector<double>> series(32);
  Moments sums;
  for (int k = 0; k < 3'000; ++k) {
    const Scene truth = truth_at(k, actors);
    const Scene seen = perception.look(truth);
    for (std::size_t i = 0; i < 32; ++i) {
      const double e = error(seen.actors[i], truth.actors[i]);
      series[i].push_back(e);
      sums.square += e * e;
      if (k >= lag) {
        sums.lagged += e * series[i][static_cast<std::size_t>(k - lag)];
      }
      ++sums.count;
    }
  }
  return {sums.square / sums.count, sums.lagged / (sums.count - 32 * lag), sums.count};
}

template <class Error>
void expect_process(const scenario::PerceptionModel& model, double sd, const Error& error) {
  const int lag = model.correlation_time > 0.0
                      ? static_cast<int>(std::lround(model.correlation_time / step))
                      : 5;
  const double phi = model.correlation_time > 0.0 ? std::exp(-step / model.correlation_time) : 0.0;
  const double wanted = std::pow(phi, lag);  // 1/e after the correlation time; 0 if white
  const Moments found = moments_of(model, lag, error);
  // Variance of the mean square: 2 sd^4 / n (1 + phi^2) / (1 - phi^2).
  const double spread = (1.0 + phi * phi) / (1.0 - phi * phi);
  const double variance_se = sd * sd * std::sqrt(2.0 * spread / found.count);
  EXPECT_NEAR(found.square, sd * sd, 4.0 * variance_se);
  // Bartlett's formula for an AR(1) process.
  const double correlation_se =
      std::sqrt(((1.0 - wanted * wanted) * spread - 2.0 * lag * wanted * wanted) / found.count);
  EXPECT_NEAR(found.lagged / found.square, wanted, 4.0 * correlation_se);
}

TEST(Perception, ErrorsHaveTheirSizeAndFadeWithTheirCorrelationTime) {
  for (const double time : {0.0, 0.05, 0.2}) {
    const scenario::PerceptionModel model{
        .position_sd = 0.3, .velocity_sd = 0.5, .heading_sd = 0.03, .correlation_time = time};
    expect_process(model, 0.3, [](const Actor& seen, const Actor& truth) {
      return seen.X_WA.p.x - truth.X_WA.p.x;
    });
    expect_process(model, 0.5,
                   [](const Actor& seen, const Actor& truth) { return seen.v_W.y - truth.v_W.y; });
    expect_process(model, 0.03, [](const Actor& seen, const Actor& truth) {
      return wrap_angle(seen.X_WA.yaw - truth.X_WA.yaw);
    });
  }
}

// An Ornstein-Uhlenbeck error less its own low-pass of time T, over T, has the variance
// sd^2 / (T (T + correlation time)).
TEST(Perception, AccelerationsErrAsVelocitiesDo) {
  const scenario::PerceptionModel model{.velocity_sd = 0.5, .correlation_time = 0.2};
  const Moments found = moments_of(
      model, 1, [](const Actor& seen, const Actor& truth) { return seen.a_W.x - truth.a_W.x; });
  const double wanted = 0.5 / std::sqrt(difference_time * (difference_time + 0.2));
  EXPECT_NEAR(std::sqrt(found.square), wanted, 0.05 * wanted);  // begins at 0; steps of 0.01 s
}

TEST(Perception, PositionsErrAlikeOnBothAxesAndByThemselves) {
  const scenario::PerceptionModel model{.position_sd = 1.0, .velocity_sd = 1.0};
  const Moments cross = moments_of(model, 1, [](const Actor& seen, const Actor& truth) {
    const double product = (seen.X_WA.p.x - truth.X_WA.p.x) * (seen.X_WA.p.y - truth.X_WA.p.y);
    return std::sqrt(std::abs(product)) * (product < 0.0 ? -1.0 : 1.0);
  });
  // E|x y| = E|x| E|y| = 2 / pi
  EXPECT_NEAR(cross.square, 2.0 / std::acos(-1.0), 4.0 / std::sqrt(cross.count));
  EXPECT_NEAR(cross.lagged, 0.0, 4.0 / std::sqrt(cross.count));
}

TEST(Perception, LatencyIsMadeUpForAtConstantVelocityAndTurningRate) {
  std::vector<Actor> actors{car(1, {40.0, 3.0}, {-15.0, 0.7}), car(2, {20.0, 0.0}, {8.0, 6.0})};
  actors[1].yaw_rate = 0.4;
  Perception perception({.latency = 0.2}, 1);
  for (int k = 0; k < 100; ++k) {
    const Scene truth = truth_at(k, actors);
    const Scene seen = perception.look(truth);
    ASSERT_EQ(seen.actors.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(seen.actors[i].age, std::min(k, 20) * step, 1e-12);
      EXPECT_NEAR(norm(seen.actors[i].X_WA.p - truth.actors[i].X_WA.p), 0.0, 1e-10);
      EXPECT_NEAR(norm(seen.actors[i].v_W - truth.actors[i].v_W), 0.0, 1e-10);
      EXPECT_NEAR(wrap_angle(seen.actors[i].X_WA.yaw - truth.actors[i].X_WA.yaw), 0.0, 1e-10);
      EXPECT_FALSE(seen.actors[i].occluded);
    }
  }
}

TEST(Perception, WhoBrakesIsSeenToDoSoALatencyLate) {
  const std::vector<Actor> steady{car(1, {40.0, 0.0}, {10.0, 0.0})};
  Perception perception({.latency = 0.1}, 1);
  for (int k = 0; k < 60; ++k) {
    Scene truth = truth_at(k, steady);
    const double since = std::max(0.0, truth.time - 0.3);
    truth.actors[0].v_W.x = 10.0 - 5.0 * since;
    truth.actors[0].X_WA.p.x -= 2.5 * since * since;
    const Actor seen = perception.look(truth).actors[0];
    const double then = std::max(0.0, truth.time - 0.1 - 0.3);
    EXPECT_NEAR(seen.v_W.x, 10.0 - 5.0 * then, 1e-10);
    if (k >= 40) {  // constant braking for all of the latency: short by a L^2 / 2
      EXPECT_NEAR(seen.X_WA.p.x - truth.actors[0].X_WA.p.x, 0.5 * 5.0 * 0.1 * 0.1, 1e-10);
    }
  }
}

TEST(Perception, DropoutsComeAtTheirRate) {
  Perception perception({.dropout = 0.3}, 11);
  const std::vector<Actor> actors = many(32);
  int lost = 0;
  constexpr int num_looks = 1'000;
  for (int k = 0; k < num_looks; ++k) {
    lost += 32 - static_cast<int>(perception.look(truth_at(k, actors)).actors.size());
  }
  const double count = 32.0 * num_looks;
  EXPECT_NEAR(lost / count, 0.3, 4.0 * std::sqrt(0.3 * 0.7 / count));
}

TEST(Perception, WhoLeavesTheRangeIsPredictedEverLessSurelyAndForgotten) {
  const std::vector<Actor> actors{car(1, {40.0, 0.0}, {20.0, 0.0})};
  const scenario::PerceptionModel model{
      .position_sd = 0.2, .velocity_sd = 0.5, .range = 50.0, .memory = 0.4};
  Perception perception(model, 3);
  Actor last;
  int missed = 0;
  for (int k = 0; k < 120; ++k) {
    const Scene truth = truth_at(k, actors);
    const Scene seen = perception.look(truth);
    if (truth.actors[0].X_WA.p.x <= 50.0) {
      ASSERT_EQ(seen.actors.size(), 1U);
      last = seen.actors[0];
      EXPECT_EQ(last.existence, 1.0);
      EXPECT_EQ(last.position_sd, 0.2);
      continue;
    }
    const double age = ++missed * step;
    if (age > 0.4 - 1e-9) {
      EXPECT_TRUE(seen.actors.empty()) << age;
      continue;
    }
    ASSERT_EQ(seen.actors.size(), 1U) << age;
    const Actor& kept = seen.actors[0];
    EXPECT_TRUE(kept.occluded);
    EXPECT_NEAR(kept.age, age, 1e-12);
    EXPECT_NEAR(kept.existence, 1.0 - age / 0.4, 1e-9);
    EXPECT_NEAR(kept.X_WA.p.x,
                last.X_WA.p.x + age * norm(last.v_W) * std::cos(0.5 * age * last.yaw_rate), 0.05);
    const double pull = 2.0 * age;  // what 2 m/s^2 unknown add
    EXPECT_NEAR(kept.velocity_sd, std::sqrt(0.25 + pull * pull), 1e-12);
    EXPECT_NEAR(kept.position_sd,
                std::sqrt(0.04 + 0.25 * age * age + 0.25 * pull * pull * age * age), 1e-12);
  }
  EXPECT_GT(missed, 60);
}

TEST(Perception, TheStatedSizeOfAnErrorHoldsAfterLatency) {
  const scenario::PerceptionModel model{
      .position_sd = 0.3, .velocity_sd = 2.0, .correlation_time = 0.05, .latency = 0.2};
  Perception perception(model, 4);
  std::vector<Actor> posts = many(32);  // at rest for good: nothing unknown pulls them
  for (Actor& post : posts) {
    post.kind = ActorKind::obstacle;
    post.v_W = {};
  }
  double square = 0.0;
  int count = 0;
  for (int k = 0; k < 2'000; ++k) {
    const Scene truth = truth_at(k, posts);
    const Scene seen = perception.look(truth);
    for (std::size_t i = 0; k >= 20 && i < 32; ++i) {
      const double sd = seen.actors[i].position_sd;
      EXPECT_NEAR(sd, std::hypot(0.3, 2.0 * 0.2), 1e-9);
      const double e = seen.actors[i].X_WA.p.y - truth.actors[i].X_WA.p.y;
      square += e * e / (sd * sd);
      ++count;
    }
  }
  EXPECT_NEAR(square / count, 1.0, 4.0 * std::sqrt(2.0 * 5.0 / count));  // 0.05 s are 5 looks
}

TEST(Perception, TheNewlySeenBecomeCertainLookByLook) {
  Perception perception({.confirmation = 0.05}, 1);
  const std::vector<double> wanted{0.2, 0.4, 0.6, 0.8, 1.0, 1.0};
  for (int k = 0; k < 6; ++k) {
    const Scene seen = perception.look(truth_at(k, many(1)));
    EXPECT_NEAR(seen.actors[0].existence, wanted[static_cast<std::size_t>(k)], 1e-12);
  }
}

TEST(Perception, AVanHidesAWalkerUntilTheEgoHasComeFarEnough) {
  // The geometry of line_of_sight_test: the front, at y = 0, first sees the nearest point of the
  // walker, (24, -2.75), past the corner (22.7, -2) of the van.
  Actor van = car(1, {20.0, -3.0}, {});
  van.kind = ActorKind::van;
  van.footprint = {world::Shape::box, 5.4, 2.0};
  Actor walker = car(1, {24.0, -3.0}, {});
  walker.kind = ActorKind::pedestrian;
  walker.footprint = {world::Shape::ellipse, 0.5, 0.5};
  const double share = 2.0 / 2.75;
  const double first = (22.7 - share * 24.0) / (1.0 - share) - 2.3;
  constexpr double speed = 10.0;
  for (const double latency : {0.0, 0.1}) {
    Perception perception({.latency = latency, .occlusion = true}, 1);
    for (int k = 0; k < 250; ++k) {
      Scene truth = truth_at(k, {van, walker});
      truth.ego.v_B = {speed, 0.0};
      truth.ego.X_WB.p.x = speed * truth.time + 0.003;
      const bool there = truth.ego.X_WB.p.x - speed * latency >= first;
      const Scene seen = perception.look(truth);
      EXPECT_EQ(find(seen, walker) != nullptr, there) << truth.time;
      EXPECT_NE(find(seen, van), nullptr);
    }
  }
}

TEST(Perception, AGhostIsPerceivedAndHidesNobody) {
  Actor ghost = car(9, {10.0, 0.0}, {5.0, 0.0});
  ghost.footprint = {world::Shape::box, 2.0, 30.0};
  ghost.existence = 0.4;
  const Actor behind = car(1, {30.0, 0.0}, {5.0, 0.0});
  const std::vector<Actor> ghosts{ghost};
  Perception perception({.occlusion = true}, 1);
  Scene seen = perception.look(truth_at(0, {behind}), ghosts);
  ASSERT_EQ(seen.actors.size(), 2U);
  EXPECT_EQ(seen.actors[0].id, 1);
  EXPECT_EQ(seen.actors[1].id, 9);
  EXPECT_EQ(seen.actors[1].existence, 0.4);
  Perception real({.occlusion = true}, 1);
  EXPECT_EQ(find(real.look(truth_at(0, {behind, ghost})), behind), nullptr);
  Perception perfect({}, 1);
  EXPECT_EQ(perfect.look(truth_at(0, {behind}), ghosts).actors.size(), 2U);
}

TEST(Perception, TheEgoBelievesAGripThatIsNotTheTrueOne) {
  Scene truth = truth_at(0, {});
  truth.grip = 0.3;
  const Scene known = Perception({.grip_sd = 0.1}, 1).look(truth);
  EXPECT_EQ(known.grip, 0.3);
  EXPECT_EQ(known.grip_sd, 0.1);
  EXPECT_EQ(Perception({.grip_believed = 0.8}, 1).look(truth).grip, 0.8);
}

TEST(Perception, TheSameSeedGivesTheSameBitsAndAnotherDoesNot) {
  Perception one(noisy, 7);
  Perception two(noisy, 7);
  Perception other(noisy, 8);
  std::optional<Perception> copy;
  int differing = 0;
  for (int k = 0; k < 200; ++k) {
    const Scene truth = truth_at(k, many(12));
    const auto seen = bits(one.look(truth));
    EXPECT_EQ(seen, bits(two.look(truth)));
    differing += seen != bits(other.look(truth)) ? 1 : 0;
    if (copy) {
      EXPECT_EQ(seen, bits(copy->look(truth)));
    } else if (k == 100) {
      copy = one;
    }
  }
  EXPECT_GT(differing, 190);
}

TEST(Perception, AnActorsErrorsAreItsOwnWhoeverElseIsThere) {
  scenario::PerceptionModel model = noisy;
  model.occlusion = false;
  Perception few(model, 7);
  Perception all(model, 7);
  std::vector<Actor> others = many(20);
  const std::vector<Actor> alone{others[13]};
  for (int k = 0; k < 200; ++k) {
    const Scene lonely = few.look(truth_at(k, alone));
    const Scene crowd = all.look(truth_at(k, others));
    const Actor* const a = find(lonely, alone[0]);
    const Actor* const b = find(crowd, alone[0]);
    ASSERT_EQ(a == nullptr, b == nullptr);
    if (a != nullptr) {
      EXPECT_EQ(bits(*a), bits(*b));
    }
  }
}

TEST(Perception, AllocatesNothingOnceItIsMadeHoweverManyComeAndGo) {
  const Perception original(noisy, 1);
  Perception perception = original;  // a copy has all its room, too
  std::vector<Scene> truths;
  std::vector<Actor> actors = many(32);
  for (int k = 0; k < 60; ++k) {
    if (k % 20 == 10) {
      for (Actor& actor : actors) {
        actor.id = static_cast<std::uint8_t>(actor.id + 32);
      }
    }
    truths.push_back(truth_at(k, actors));
  }
  std::size_t most = 0;
  const std::size_t before = num_allocations;
  for (const Scene& truth : truths) {
    most = std::max(most, perception.look(truth).actors.size());
  }
  EXPECT_EQ(num_allocations, before);
  EXPECT_GT(most, 10U);
}

TEST(Perception, NobodyThereAndSomebodyAtTheEgosOwnPlace) {
  Perception perception(noisy, 1);
  EXPECT_TRUE(perception.look(truth_at(0, {})).actors.empty());
  Actor on_top = car(1, {}, {});
  on_top.footprint.length = 5.0;  // more than the ego's: it covers the eyes
  const std::vector<Actor> actors{on_top, car(2, {30.0, 0.0}, {})};
  for (int k = 1; k < 60; ++k) {
    EXPECT_FALSE(world::broken_rule(perception.look(truth_at(k, actors))));
  }
  const Scene seen = Perception({.occlusion = true}, 1).look(truth_at(0, actors));
  ASSERT_EQ(seen.actors.size(), 1U);
  EXPECT_EQ(seen.actors[0].id, 1);
}

TEST(Perception, RefusesWhatIsNoSceneAndLooksThatAreNotAStepApart) {
  Scene truth = truth_at(0, many(2));
  truth.actors[1].v_W.x = std::nan("");
  EXPECT_THROW((void)Perception(noisy, 1).look(truth), ContractViolation);
  const std::vector<Actor> twin{many(1)[0]};
  EXPECT_THROW((void)Perception(noisy, 1).look(truth_at(0, many(2)), twin), ContractViolation);
  EXPECT_THROW((void)Perception({}, 1).look(truth_at(0, many(32)), twin), ContractViolation);
  Perception perception(noisy, 1);
  (void)perception.look(truth_at(0, many(2)));
  EXPECT_THROW((void)perception.look(truth_at(2, many(2))), ContractViolation);
}

TEST(Perception, RefusesAModelOutOfRange) {
  const double nan = std::nan("");
  for (const scenario::PerceptionModel& model :
       {scenario::PerceptionModel{.position_sd = -0.1},
        scenario::PerceptionModel{.velocity_sd = nan},
        scenario::PerceptionModel{.heading_sd = -1.0},
        scenario::PerceptionModel{.correlation_time = -1.0},
        scenario::PerceptionModel{.latency = 2.1}, scenario::PerceptionModel{.latency = nan},
        scenario::PerceptionModel{.dropout = 1.1}, scenario::PerceptionModel{.range = 0.0},
        scenario::PerceptionModel{.range = nan}, scenario::PerceptionModel{.confirmation = -1.0},
        scenario::PerceptionModel{.memory = nan}, scenario::PerceptionModel{.grip_believed = 0.0},
        scenario::PerceptionModel{.grip_believed = 1.3},
        scenario::PerceptionModel{.grip_sd = -0.1}}) {
    EXPECT_THROW(Perception(model, 1), ContractViolation);
  }
}

}  // namespace
}  // namespace saca::sim::perception_test
