#include "saca/onboard/reflex/track_confirmation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>

#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"

namespace saca::reflex::track_confirmation_test {
namespace {

using test::block;
using test::ego_at;
using world::Scene;

/// Nobody but a car far away, which is seen in every look.
Scene quiet(double time) {
  Scene scene = ego_at(20.0);
  scene.time = time;
  scene.actors.push_back(block(9, {150.0, 0.0}));
  return scene;
}

/// With somebody 20 m ahead.
Scene with_one(double time, double existence = 1.0) {
  Scene scene = quiet(time);
  scene.actors.push_back(block(1, {24.0, 0.0}));
  scene.actors[1].existence = existence;
  return scene;
}

bool last_is_confirmed(const TrackConfirmation& tracks, const Scene& scene) {
  return tracks.confirmed().test(scene.actors.size() - 1);
}

/// Looks so far apart, the first an old one; 'x': somebody is seen, '.': not, '~': carried on
/// without being measured anew.
/// @return  in which look he is confirmed, from 0
std::optional<int> confirmed_in(std::string_view looks, double period, double existence = 1.0) {
  TrackConfirmation tracks;
  tracks.look(quiet(0.0));
  double measured = 0.0;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const double time = period * static_cast<double>(k + 1);
    measured = looks[k] == 'x' ? time : measured;
    Scene scene = looks[k] == '.' ? quiet(time) : with_one(time, existence);
    scene.actors[scene.actors.size() - 1].age = looks[k] == '~' ? time - measured : 0.0;
    tracks.look(scene);
    if (looks[k] != '.' && last_is_confirmed(tracks, scene)) {
      return static_cast<int>(k);
    }
  }
  return std::nullopt;
}

TEST(TrackConfirmation, NeedsTwoLooksOfThree) {
  EXPECT_EQ(confirmed_in("xx", 0.01), 1);
  EXPECT_EQ(confirmed_in("x.x", 0.01), 2);
  EXPECT_EQ(confirmed_in("x..x", 0.01), std::nullopt);
  EXPECT_EQ(confirmed_in("x..xx", 0.01), 4);
  EXPECT_EQ(confirmed_in("x.....x....x.....x", 0.01), std::nullopt);
}

TEST(TrackConfirmation, ToBeCarriedOnIsNotToBeSeen) {
  constexpr double unlikely = 0.4;
  EXPECT_EQ(confirmed_in("x~~~~~~~~", 0.01, unlikely), std::nullopt);
  EXPECT_EQ(confirmed_in("x~x", 0.01, unlikely), 2);
  EXPECT_EQ(confirmed_in("x~~x", 0.01, unlikely), 3) << "carried on for 20 ms is not missed";
  EXPECT_EQ(confirmed_in("x~~x", 0.05, unlikely), 3) << "missed once";
  EXPECT_EQ(confirmed_in("x~~~~x", 0.05, unlikely), std::nullopt) << "missed twice";
}

// Scenes come at 100 Hz, and each road user is measured in every tenth, others in others. Whom
// perception believes in waits for 50 ms, anybody else to be measured again.
TEST(TrackConfirmation, TakesWhoIsMeasuredSeldomerThanScenesCome) {
  for (const auto& [existence, expected] : {std::pair(1.0, 6), std::pair(0.4, 11)}) {
    TrackConfirmation tracks;
    tracks.look(quiet(0.0));
    for (int k = 1; k <= 25; ++k) {
      Scene scene = with_one(0.01 * k, existence);
      scene.actors[1].age = 0.01 * ((k - 1) % 10);
      tracks.look(scene);
      EXPECT_EQ(last_is_confirmed(tracks, scene), k >= expected) << k;
    }
  }
}

// Every rate from 10 to 100 Hz: a road user whom perception believes in waits for 50 ms at most.
TEST(TrackConfirmation, NeverWaitsLongerThanStated) {
  for (int rate = 10; rate <= 100; ++rate) {
    const double period = 1.0 / rate;
    const auto look = confirmed_in("xx", period);
    ASSERT_TRUE(look.has_value());
    EXPECT_LE(*look * period, TrackConfirmation::longest_wait + 1e-9) << rate << " Hz";
    EXPECT_EQ(confirmed_in("x", period, 0.4), std::nullopt) << rate << " Hz";
    EXPECT_EQ(confirmed_in("xx", period, 0.4), 1) << rate << " Hz";
  }
  EXPECT_EQ(confirmed_in("x", 0.05), std::nullopt);
}

// Oracle: count the last three looks of a random series.
TEST(TrackConfirmation, CountsTheLastThreeLooks) {
  std::mt19937 rng(2);
  std::bernoulli_distribution seen(0.15);
  for (int i = 0; i < 500; ++i) {
    std::string looks;
    std::optional<int> expected;
    for (int k = 0; k < 20; ++k) {
      looks += seen(rng) ? 'x' : '.';
      const std::string last = looks.substr(looks.size() - std::min<std::size_t>(3, looks.size()));
      const bool twice = std::count(last.begin(), last.end(), 'x') >= 2;
      if (!expected && twice && last.back() == 'x') {
        expected = k;
      }
    }
    EXPECT_EQ(confirmed_in(looks, 0.02), expected) << looks;
  }
}

TEST(TrackConfirmation, WhoIsConfirmedStaysSoWhileOccluded) {
  TrackConfirmation tracks;
  tracks.look(quiet(0.0));
  for (int k = 1; k <= 100; ++k) {
    Scene scene = with_one(0.01 * k);
    scene.actors[1].age = k <= 2 ? 0.0 : 0.01 * (k - 2);
    scene.actors[1].occluded = k > 2;
    tracks.look(scene);
    EXPECT_EQ(last_is_confirmed(tracks, scene), k >= 2) << k;
  }
}

// Carried on for 0.4 s behind something, then missing from one scene.
TEST(TrackConfirmation, WhoWasOccludedAndIsMissingOnceIsNotForgotten) {
  TrackConfirmation tracks;
  tracks.look(with_one(0.0));
  double time = 0.0;
  for (int k = 1; k <= 40; ++k) {
    time = 0.01 * k;
    Scene scene = with_one(time);
    scene.actors[1].age = time;
    tracks.look(scene);
    ASSERT_TRUE(last_is_confirmed(tracks, scene)) << k;
  }
  tracks.look(quiet(time + 0.01));
  const Scene scene = with_one(time + 0.02, 0.4);
  tracks.look(scene);
  EXPECT_TRUE(last_is_confirmed(tracks, scene));
}

// A name that is used again for somebody elsewhere, at once or after a look, says nothing of him.
TEST(TrackConfirmation, ANameElsewhereIsAnother) {
  for (const int num_missed : {0, 1}) {
    TrackConfirmation tracks;
    tracks.look(with_one(0.0));
    int k = 1;
    for (; k <= num_missed; ++k) {
      tracks.look(quiet(0.01 * k));
    }
    Scene scene = quiet(0.01 * k);
    scene.actors.push_back(block(1, {24.0, 30.0}));
    tracks.look(scene);
    EXPECT_FALSE(last_is_confirmed(tracks, scene)) << num_missed;
    scene.time += 0.01;
    tracks.look(scene);
    EXPECT_TRUE(last_is_confirmed(tracks, scene)) << num_missed;
  }
}

// 16 m away, not measured for 2 s: it may have braked by 10 m/s2 meanwhile.
TEST(TrackConfirmation, WhoComesOutOfAnOcclusionElsewhereIsTheSame) {
  TrackConfirmation tracks;
  tracks.look(with_one(0.0));
  for (int k = 1; k < 200; ++k) {
    Scene scene = with_one(0.01 * k);
    scene.actors[1].age = 0.01 * k;
    tracks.look(scene);
  }
  Scene scene = with_one(2.0, 0.4);
  scene.actors[1].X_WA.p.x += 16.0;
  tracks.look(scene);
  EXPECT_TRUE(last_is_confirmed(tracks, scene));
}

// Two that exchange their names at every look are who they were.
TEST(TrackConfirmation, ExchangedNamesChangeNothing) {
  TrackConfirmation tracks;
  for (int k = 0; k < 6; ++k) {
    Scene scene = quiet(0.01 * k);
    const auto first = static_cast<std::uint8_t>(1 + k % 2);
    scene.actors.push_back(block(first, {24.0, 0.0}));
    scene.actors.push_back(block(static_cast<std::uint8_t>(3 - first), {24.0, 30.0}));
    tracks.look(scene);
    EXPECT_EQ(tracks.confirmed().count(), 3U) << k;
  }
}

// A tracker that names everybody anew at every look.
TEST(TrackConfirmation, WhoHasANewNameIsWhoHeWas) {
  TrackConfirmation tracks;
  tracks.look(quiet(0.0));
  for (int k = 1; k <= 5; ++k) {
    Scene scene = quiet(0.02 * k);
    scene.actors.push_back(
        block(static_cast<std::uint8_t>(10 + k), {60.0 - 30.0 * 0.02 * k, 0.0}, {-30.0, 0.0}));
    tracks.look(scene);
    EXPECT_EQ(last_is_confirmed(tracks, scene), k >= 2) << k;
  }
  // Another one elsewhere is not.
  Scene scene = quiet(0.12);
  scene.actors.push_back(block(77, {30.0, 3.5}, {-30.0, 0.0}));
  tracks.look(scene);
  EXPECT_FALSE(last_is_confirmed(tracks, scene));
}

TEST(TrackConfirmation, WhoWasGoneForThreeLooksIsNew) {
  const auto after = [](int num_missed) {
    TrackConfirmation tracks;
    tracks.look(with_one(0.0));
    int k = 1;
    for (; k <= num_missed; ++k) {
      tracks.look(quiet(0.01 * k));
    }
    const Scene scene = with_one(0.01 * k);
    tracks.look(scene);
    return last_is_confirmed(tracks, scene);
  };
  EXPECT_TRUE(after(2));
  EXPECT_FALSE(after(3));
}

TEST(TrackConfirmation, BelievesWhatItBeginsWith) {
  TrackConfirmation tracks;
  for (const double time : {5.0, 6.5, 2.0}) {  // the first, after a gap, and back
    const Scene scene = with_one(time);
    tracks.look(scene);
    EXPECT_TRUE(last_is_confirmed(tracks, scene)) << time;
    tracks.look(quiet(time + 0.01));
    tracks.look(quiet(time + 0.02));
    tracks.look(quiet(time + 0.03));
  }
}

// Scenes come at 10 Hz, and ten times as often what is carried on: no new look.
TEST(TrackConfirmation, DoesNotCountWhatIsOnlyCarriedOn) {
  TrackConfirmation tracks;
  const auto see = [&](int k, bool there) {
    Scene scene = there ? with_one(0.1 * k, 0.4) : quiet(0.1 * k);
    for (int i = 0; i < 10; ++i) {
      tracks.look(scene);
      scene.time += 0.01;
      for (world::Actor& actor : scene.actors) {
        actor.age += 0.01;
      }
    }
    return there && last_is_confirmed(tracks, scene);
  };
  EXPECT_FALSE(see(0, false));
  EXPECT_FALSE(see(1, true));
  EXPECT_FALSE(see(2, false));
  EXPECT_TRUE(see(3, true)) << "two looks of three";
}

TEST(TrackConfirmation, AllocatesNothingAndTakesAFullScene) {
  TrackConfirmation tracks;
  const std::size_t before = num_allocations;
  for (int k = 0; k < 6; ++k) {  // 32 of 64 names, others in every look
    Scene scene = ego_at(20.0);
    scene.time = 0.01 * k;
    for (int i = 0; i < 32; ++i) {
      scene.actors.push_back(block(static_cast<std::uint8_t>(1 + i + 32 * (k % 2)),
                                   {10.0 * i, k % 2 == 0 ? 5.0 : 30.0}));
    }
    tracks.look(scene);
    EXPECT_EQ(tracks.confirmed().count(), k == 0 || k >= 2 ? 32U : 0U) << k;
  }
  EXPECT_EQ(num_allocations, before);
}

}  // namespace
}  // namespace saca::reflex::track_confirmation_test
