#include "saca/thinking/preview/follower_answers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "saca/base/core/contract.h"
#include "tests/support/scenes.h"

namespace saca::preview::follower_answers_test {
namespace {

using test::block;
using test::ego_at;
using test::whole_metres;
using world::Scene;
using world::Track;

constexpr double until = 10.0;
constexpr double step = 1.0 / 16.0;

/// Two who follow an ego at 20 m/s in a bend, the farther one listed first, and one beside it.
Scene followed() {
  Scene scene = ego_at(20.0, whole_metres);
  scene.road.curvature = 0.0005;
  scene.actors.push_back(block(1, {-45.0, 0.0}, {20.0, 0.0}));
  scene.actors.push_back(block(2, {5.0, 3.5}, {20.0, 0.0}));
  scene.actors.push_back(block(3, {-22.0, 0.0}, {21.0, 0.0}));
  return scene;
}

/// Brakes with 6 m/s^2 from 1 s on; from `impact` on, turning, as hard as that, to rest.
Track struck_at(double impact, double deceleration) {
  Track track{.step = 0.04, .X_WA = {}};
  Pose pose;
  double speed = 20.0;
  for (int k = 0; k <= 400 && speed > 0.0; ++k) {
    track.X_WA.push_back(pose);
    const double time = k * track.step;
    const double braking = time >= impact ? deceleration : time >= 1.0 ? 6.0 : 0.0;
    speed = std::max(0.0, speed - braking * track.step);
    pose.p.x += speed * track.step;
    pose.yaw += time >= impact ? 0.02 : 0.0;
  }
  return track;
}

void expect_as_let_react(const Scene& scene, std::span<const Track> answers, const Track& X_WB) {
  std::vector<Track> reference(scene.actors.size());
  const reflex::Followers followers = reflex::followers_of(scene);
  reflex::let_react(scene, followers, X_WB, until, step, reference);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Track& track = reference[followers[i]];
    EXPECT_EQ(answers[i].start, track.start);
    EXPECT_EQ(answers[i].step, track.step);
    ASSERT_EQ(answers[i].X_WA.size(), track.X_WA.size());
    for (std::size_t k = 0; k < track.X_WA.size(); ++k) {
      EXPECT_EQ(answers[i].X_WA[k].p.x, track.X_WA[k].p.x) << i << " " << k;
      EXPECT_EQ(answers[i].X_WA[k].p.y, track.X_WA[k].p.y) << i << " " << k;
      EXPECT_EQ(answers[i].X_WA[k].yaw, track.X_WA[k].yaw) << i << " " << k;
    }
  }
}

// Whatever was asked before, and whichever way is remembered: to the last bit what let_react does.
TEST(FollowerAnswers, AreThoseOfLetReact) {
  const Scene scene = followed();
  for (const bool remembers : {false, true}) {
    FollowerAnswers answers(scene, until, step);
    ASSERT_EQ(answers.followers().size(), 2U);
    EXPECT_EQ(answers.followers()[0], 2U);  // the nearest first
    if (remembers) {
      answers.remember(struck_at(100.0, 0.0));
    }
    for (const double impact : {100.0, 2.0, 3.0, 2.5, 0.0, 0.5, 3.0, 100.0}) {
      for (const double deceleration : {8.0, 30.0}) {
        const Track X_WB = struck_at(impact, deceleration);
        expect_as_let_react(scene, answers.to(X_WB, 2), X_WB);
      }
    }
  }
}

// The farther follower is left out once it does not matter, and is there again when it does.
TEST(FollowerAnswers, AreOfAsManyFollowersAsAreAskedFor) {
  const Scene scene = followed();
  FollowerAnswers answers(scene, until, step);
  answers.remember(struck_at(100.0, 0.0));
  for (const std::size_t num : {2U, 1U, 2U, 1U, 0U, 2U}) {
    const Track X_WB = struck_at(2.0 + 0.1 * static_cast<double>(num), 12.0);
    const auto tracks = answers.to(X_WB, num);
    ASSERT_EQ(tracks.size(), num);
    expect_as_let_react(scene, tracks, X_WB);
  }
  EXPECT_THROW((void)answers.to(struck_at(1.0, 6.0), 3), ContractViolation);
}

TEST(FollowerAnswers, OfNobodyAreNone) {
  Scene scene = followed();
  scene.actors.clear();
  FollowerAnswers answers(scene, until, step);
  EXPECT_TRUE(answers.followers().empty());
  EXPECT_TRUE(answers.to(struck_at(1.0, 6.0), 0).empty());
}

}  // namespace
}  // namespace saca::preview::follower_answers_test
