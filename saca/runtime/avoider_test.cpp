#include "saca/runtime/avoider.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/runtime/replay.h"
#include "saca/thinking/intent/shipped_model.h"
#include "tests/support/count_allocations.h"
#include "tests/support/scenes.h"
#include "tests/support/system_calls.h"

namespace saca::avoider_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Test;
using world::Actor;
using world::Scene;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One of the paper's eight policies with the parameter that belongs to it, and a threat of those
/// that there may be.
void expect_valid(const Answer& answer) {
  if (answer.plan) {
    EXPECT_LT(manoeuvre::index(answer.plan->policy), manoeuvre::num_policies);
    EXPECT_EQ(answer.plan->target_speed.has_value(),
              manoeuvre::brakes_to_speed(answer.plan->policy));
    EXPECT_GE(answer.plan->target_speed.value_or(0.0), 0.0);
  }
  if (answer.threat) {
    EXPECT_LT(answer.threat->actor, world::max_actors);
    EXPECT_GE(answer.threat->time, 0.0);
  }
}

/// The texts of all events that wait.
std::string events(Avoider& avoider) {
  std::string texts;
  while (const auto event = avoider.next_event()) {
    texts += event->text + "\n";
  }
  return texts;
}

/// A car with an avoider on a road of three lanes, its vehicle model driven by it.
class Drive {
 public:
  explicit Drive(double speed, double grip = 0.9)
      : avoider_({.planes = {.forecast = {&car_, &harm_},
                             .costs = {.preview = 0.05, .verdict = 0.03},
                             .clock = &clock_,
                             .tape_size = 2'000 * runtime::Tape::step_size(1)},
                  .intent = &intent::shipped_model()}),
        scene_(test::ego_at(speed, manoeuvre::footprint(car_))) {
    scene_.ego_mass = car_.mass;
    scene_.grip = grip;
    scene_.road.left_edge = 5.25;
    scene_.road.right_edge = -5.25;
    state_ = manoeuvre::rolling_state(car_, scene_.ego, grip);
  }

  Scene& scene() { return scene_; }
  Avoider& avoider() { return avoider_; }
  [[nodiscard]] runtime::Replay replayed() {
    return runtime::replay(avoider_.tape().content(),
                           {.forecast = {&car_, &harm_}, .clock = &clock_}, intent::shipped_model(),
                           arbitration::usual_draws);
  }

  /// One instant of 10 ms; actors go on evenly.
  Answer step() {
    return step([this] { return avoider_.step(scene_); });
  }
  /// Likewise, where perception delivers something else than the scene.
  template <class Perceive>
  Answer step(const Perceive& perceive) {
    const Answer answer = perceive();
    expect_valid(answer);
    constexpr double dt = 0.001;
    for (int k = 0; k < 10; ++k) {
      const vehicle::Command command = avoider_.control(state_, dt);
      EXPECT_TRUE(std::isfinite(command.steering));
      state_ = vehicle::step(car_, state_, command, scene_.grip, dt);
    }
    scene_.time += 0.01;
    scene_.ego = manoeuvre::ego_state(state_);
    for (world::Actor& actor : scene_.actors) {
      actor.X_WA.p = actor.X_WA.p + 0.01 * actor.v_W;
    }
    return answer;
  }

 private:
  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  Avoider avoider_;
  Scene scene_;
  vehicle::VehicleState state_;
};

TEST(Avoider, OnAnEmptyRoadTheStackDrives) {
  Drive drive(20.0);
  for (int k = 0; k < 100; ++k) {
    const Answer answer = drive.step();
    EXPECT_FALSE(answer.plan.has_value());
    EXPECT_FALSE(answer.threat.has_value());
  }
  EXPECT_EQ(drive.avoider().decision(), std::nullopt);
}

// Braking from 12 m/s on a dry road takes some 9 m; at T1 there are 15.
TEST(Avoider, StopsBeforeAWreck) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {60.0, 0.0}));
  std::vector<PolicyId> begun;
  for (int k = 0; k < 900; ++k) {
    const Answer answer = drive.step();
    if (answer.begins) {
      EXPECT_TRUE(answer.triggered);
      EXPECT_FALSE(drive.avoider().finished());
      begun.push_back(answer.plan.value().policy);
    }
    EXPECT_EQ(drive.avoider().plan(), answer.plan);
  }
  EXPECT_TRUE(drive.avoider().finished() || drive.avoider().num_encounters() == 1);
  EXPECT_EQ(begun, std::vector{PolicyId::aeb});
  EXPECT_LT(norm(drive.scene().ego.v_B), 0.1);
  const double front = drive.scene().ego.X_WB.p.x + 2.3;
  EXPECT_LT(front, 60.0 - 2.25);
  EXPECT_GT(front, 60.0 - 2.25 - 8.0);
}

// On wet road braking from 20 m/s takes 43 m; the lane beside is free.
TEST(Avoider, SwervesWhereBrakingHitsAndGivesTheWheelBack) {
  Drive drive(20.0, 0.5);
  drive.scene().actors.push_back(test::car(1, {90.0, 0.0}));
  bool had_plan = false;
  Answer last;
  for (int k = 0; k < 1'200; ++k) {
    last = drive.step();
    had_plan = had_plan || last.plan.has_value();
    const Vec2 apart = drive.scene().ego.X_WB.p - drive.scene().actors[0].X_WA.p;
    ASSERT_FALSE(std::abs(apart.x) < 4.4 && std::abs(apart.y) < 1.7) << "they touch";
  }
  EXPECT_TRUE(had_plan);
  EXPECT_FALSE(last.plan.has_value());
  EXPECT_EQ(drive.avoider().num_encounters(), 1U);
  EXPECT_EQ(drive.avoider().decision(), std::nullopt) << "the next encounter is another";
}

TEST(Avoider, DecidesAnewInTheNextEncounter) {
  Drive drive(14.0);
  for (int encounter = 0; encounter < 2; ++encounter) {
    drive.scene().actors.clear();
    const world::EgoState& ego = drive.scene().ego;
    drive.scene().actors.push_back(test::car(1, {ego.X_WB.p.x + 3.0 * ego.v_B.x, 0.0}));
    bool begun = false;
    for (int k = 0; k < 400 && !begun; ++k) {
      begun = drive.step().begins;
    }
    EXPECT_TRUE(begun) << encounter;
    drive.scene().actors.clear();  // it drives away
    for (int k = 0; k < 400; ++k) {
      (void)drive.step();
    }
    EXPECT_EQ(drive.avoider().num_encounters(), static_cast<std::size_t>(encounter) + 1);
    EXPECT_GT(drive.scene().ego.v_B.x, 2.0) << "the wheel was given back, not a full stop";
  }
  // Both encounters stand on the tape, the end of the first between them, and come back.
  const runtime::Replay replay = drive.replayed();
  EXPECT_FALSE(replay.first.has_value()) << replay.first->what;
  EXPECT_EQ(replay.decisions.recorded, 2U);
  EXPECT_EQ(replay.decisions.same, 2U);
  EXPECT_GE(replay.switches.same, 2U);
  EXPECT_EQ(replay.beliefs_not_compared + replay.verdicts_not_compared, 0U);
}

TEST(Avoider, StandsDownForADriverAndActsAgainWhereSomebodyStillThreatens) {
  Drive drive(14.0);
  drive.scene().actors.push_back(test::car(1, {60.0, 0.0}));
  drive.avoider().stand_down();
  EXPECT_EQ(drive.avoider().num_encounters(), 0U) << "there was none";
  const auto begins_within = [&](int num_steps) {
    bool begun = false;
    for (int k = 0; k < num_steps && !begun; ++k) {
      begun = drive.step().begins;
    }
    return begun;
  };
  ASSERT_TRUE(begins_within(400));
  for (std::size_t encounter = 1; encounter <= 2; ++encounter) {
    drive.avoider().stand_down();
    EXPECT_EQ(drive.avoider().plan(), std::nullopt);
    EXPECT_EQ(drive.avoider().decision(), std::nullopt);
    EXPECT_EQ(drive.avoider().num_encounters(), encounter);
    EXPECT_EQ(begins_within(30), encounter == 1U) << "14 m/s, and 18 m to go; then nobody";
    drive.scene().actors.clear();
  }
}

// Perception drops out 0.3 s before T1 and stays away: everything is carried on, and it triggers.
TEST(Avoider, TriggersWithoutAScene) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {60.0, 0.0}));
  std::optional<double> conflict;
  while (!conflict || *conflict > 1.6) {
    const Answer answer = drive.step();
    conflict = answer.threat ? std::optional(answer.threat->time) : std::nullopt;
    ASSERT_LT(drive.scene().time, 5.0);
  }
  const double lost = drive.scene().time;
  bool begun = false;
  for (int k = 0; k < 45 && !begun; ++k) {
    const Answer answer = drive.avoider().step(lost + 0.01 * k);
    EXPECT_TRUE(answer.degraded);
    begun = answer.begins;
  }
  EXPECT_TRUE(begun);
}

TEST(Avoider, WhateverComesInTheAnswerIsValid) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {30.0, 0.0}));
  (void)drive.step();
  Scene broken = drive.scene();
  broken.ego.v_B.x = std::numeric_limits<double>::quiet_NaN();
  broken.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(drive.avoider().step(broken).degraded);
  Scene doubled = drive.scene();
  doubled.actors.push_back(doubled.actors[0]);
  EXPECT_TRUE(drive.avoider().step(doubled).degraded);
  bool begun = false;
  for (int k = 0; k < 200 && !begun; ++k) {
    begun = drive.step().begins;
  }
  EXPECT_TRUE(begun);
}

TEST(Avoider, TellsWhatItDid) {
  Drive drive(12.0);
  drive.scene().actors.push_back(test::car(1, {40.0, 0.0}));
  for (int k = 0; k < 300; ++k) {
    (void)drive.step();
  }
  std::vector<arbitration::Event> driving;
  std::size_t num_thoughts = 0;
  while (auto event = drive.avoider().next_event()) {
    if (event->plane == arbitration::Plane::thinking) {
      ++num_thoughts;
    } else {
      driving.push_back(*std::move(event));
    }
  }
  EXPECT_GT(num_thoughts, 0U);
  ASSERT_GE(driving.size(), 3U);
  EXPECT_EQ(driving[0].kind, arbitration::EventKind::trigger);
  EXPECT_THAT(driving[0].text, HasSubstr("car1"));
  EXPECT_EQ(driving[1].text, arbitration::decision_text(drive.avoider().decision().value()));
  EXPECT_EQ(driving[2].text, "policy 0 AEB (arbiter)");
}

// Who wants to hear the thinking plane while it thinks gets all of it, and `next_event` the rest.
// What was thought is handed over when the encounter is over, and in the end.
TEST(Avoider, WhoListensToTheThinkingPlaneHearsItAtOnce) {
  const manoeuvre::Car car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  SteadyClock clock;
  std::size_t num_heard = 0;
  std::vector<std::pair<std::uint32_t, std::size_t>> thought;  // encounter, events of it
  const runtime::Planes::Listener listener{
      .event = [&](const arbitration::Event&) { ++num_heard; },
      .thought =
          [&](std::uint32_t encounter, const std::vector<arbitration::Preview>& previews,
              const std::vector<arbitration::Event>& events, int) {
            EXPECT_FALSE(previews.empty());
            thought.emplace_back(encounter, events.size());
          }};
  Avoider avoider({.planes = {.forecast = {&car, &harm}, .clock = &clock},
                   .intent = &intent::shipped_model(),
                   .thinking = listener,
                   .num_timed = 10});
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  std::vector<std::uint32_t> encounters;
  for (int k = 0; k < 900; ++k) {
    if (k == 0 || k == 450) {  // a wreck that is there for a second
      encounters.push_back(avoider.planes().encounter() + (k == 0 ? 1 : 0));
      scene.actors.push_back(test::car(1, {scene.ego.X_WB.p.x + 50.0, 0.0}));
    } else if (k == 100 || k == 550) {
      scene.actors.clear();
    }
    (void)avoider.step(scene);
    EXPECT_EQ(avoider.scene().time, scene.time);
    EXPECT_EQ(avoider.beliefs().size(), scene.actors.size());
    scene.time += 0.01;
    scene.ego.X_WB.p.x += 0.12;
  }
  EXPECT_EQ(avoider.finish(), "");
  ASSERT_EQ(thought.size(), 2U);
  EXPECT_EQ(thought[0].first, encounters[0]);
  EXPECT_EQ(thought[1].first, encounters[1]);
  EXPECT_GT(thought[0].second, 0U);
  EXPECT_EQ(thought[0].second + thought[1].second, num_heard);
  EXPECT_EQ(avoider.planes().timing().calls, 10U);
  while (const auto event = avoider.next_event()) {
    EXPECT_NE(event->plane, arbitration::Plane::thinking) << event->text;
  }
}

// Nobody ever reads: the oldest events wait, the number of the others is told, and it goes on.
TEST(Avoider, DoesNotWaitForWhoReadsItsEvents) {
  Drive drive(12.0);
  Scene& scene = drive.scene();
  scene.actors.push_back(test::car(1, {500.0, 0.0}));
  for (int k = 0; k < 600; ++k) {  // every other scene is broken: 599 changes are remarked on
    (void)drive.step([&] {
      Scene seen = scene;
      seen.actors[0].v_W.x = k % 2 == 0 ? nan : 0.0;
      return drive.avoider().step(seen);
    });
  }
  const std::string texts = events(drive.avoider());
  EXPECT_EQ(std::count(texts.begin(), texts.end(), '\n'), 256 + 1);
  EXPECT_THAT(texts, HasSubstr(std::to_string(600 - 256) + " events"));
}

/// Something wrong with what perception delivers for half a second.
struct PerceptionFault {
  const char* name;
  std::function<Answer(Avoider&, const Scene& truth, const Scene& last)> deliver;
  const char* told;  ///< in an event
};

/// A scene comes, but something about it is changed.
auto with(const std::function<void(Scene& scene, const Scene& last)>& spoil) {
  return [spoil](Avoider& avoider, const Scene& truth, const Scene& last) {
    Scene scene = truth;
    spoil(scene, last);
    return avoider.step(scene);
  };
}

const std::vector<PerceptionFault>& perception_faults() {
  static const std::vector<PerceptionFault> all{
      {"nothing comes",
       [](Avoider& avoider, const Scene& truth, const Scene&) { return avoider.step(truth.time); },
       "everything is carried on"},
      {"the last scene again",
       [](Avoider& avoider, const Scene&, const Scene& last) { return avoider.step(last); },
       "policy 0 AEB"},
      {"time goes back", with([](Scene& scene, const Scene&) { scene.time -= 0.3; }),
       "no scene to decide by"},
      {"time jumps ahead and back", with([](Scene& scene, const Scene&) {
         scene.time += std::lround(100.0 * scene.time) % 2 == 0 ? 20.0 : 0.0;
       }),
       "a new drive begins"},
      {"a road user is not a number",
       with([](Scene& scene, const Scene&) { scene.actors[0].X_WA.p.x = nan; }),
       "carried on instead of seen"},
      {"the ego is not a number", with([](Scene& scene, const Scene&) { scene.ego.v_B.x = nan; }),
       "carried on instead of seen"},
      {"everything is not a number", with([](Scene& scene, const Scene&) {
         scene.time = nan;
         scene.grip = nan;
       }),
       "carried on instead of seen"},
      {"the most that fit", with([](Scene& scene, const Scene&) {
         for (std::uint8_t id = 3; !scene.actors.full(); ++id) {
           scene.actors.push_back(test::car(id, {300.0 + 10.0 * id, 60.0}));
         }
       }),
       "policy 0 AEB"},
      {"others than before, the most that fit", with([](Scene& scene, const Scene&) {
         scene.actors[1].mass = nan;  // cannot be used, and is carried on only where there is room
         for (std::uint8_t id = 3; !scene.actors.full(); ++id) {
           const auto many = static_cast<std::uint8_t>(id + std::lround(100.0 * scene.time) % 200);
           scene.actors.push_back(test::car(many, {300.0 + 10.0 * id, 60.0}));
         }
       }),
       "carried on instead of seen"},
      {"two names are swapped", with([](Scene& scene, const Scene&) {
         if (std::lround(100.0 * scene.time) % 2 == 0) {
           std::swap(scene.actors[0].id, scene.actors[1].id);
         }
       }),
       "policy 0 AEB"},
  };
  return all;
}

// At 12 m/s towards a wreck, somebody beside in the same direction. Half a second of fault begins
// well before T1, or spans it. The car stops before the wreck either way: full braking takes 9.5 m,
// deployed at most 12 % more (docs/architecture.md), and 0.5 s after T1 there are
// (1.3 - 0.5) * 12 = 9.6 m and half a metre of what "conflict" has in hand; what is carried on
// triggers in time.
TEST(Avoider, OutlivesWhatPerceptionDoesForHalfASecond) {
  for (const double begins : {2.4, 1.5}) {  // time to the conflict [s]
    for (const PerceptionFault& fault : perception_faults()) {
      SCOPED_TRACE(std::string(fault.name) + " from " + std::to_string(begins) + " s before on");
      Drive drive(12.0);
      Scene& scene = drive.scene();
      scene.actors.push_back(test::car(1, {45.0, 0.0}));
      scene.actors.push_back(test::car(2, {3.0, 3.5}, {12.0, 0.0}));
      const double conflict = (45.0 - 2.25 - 2.35) / 12.0;  // from bumper to bumper [s]
      const double first = conflict - begins;
      Scene last = scene;
      int num_begun = 0;
      std::optional<manoeuvre::Plan> plan;
      for (int k = 0; k < 700; ++k) {
        const bool is_wrong = scene.time >= first && scene.time < first + 0.5;
        const Answer answer =
            is_wrong ? drive.step([&] { return fault.deliver(drive.avoider(), scene, last); })
                     : drive.step();
        if (!is_wrong) {
          last = scene;
        }
        num_begun += answer.begins ? 1 : 0;
        plan = answer.plan ? answer.plan : plan;
      }
      EXPECT_GE(num_begun, 1);
      EXPECT_EQ(plan.value().policy, PolicyId::aeb);
      EXPECT_LT(norm(scene.ego.v_B), 0.1);
      EXPECT_LT(scene.ego.X_WB.p.x + 2.35, 45.0 - 2.25) << "they touch";
      EXPECT_THAT(events(drive.avoider()), HasSubstr(fault.told));
      EXPECT_FALSE(drive.step().degraded) << "it is over";
    }
  }
}

/// Stands still whoever waits.
class StoppedClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return Time{0}; }
  void wait_until(Time) noexcept override { std::this_thread::yield(); }
};

// No thread beside ever comes to work on anything; the driving one decides as if there were none.
TEST(Avoider, BrakesWhereTheClockStandsStill) {
  const manoeuvre::Car car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  StoppedClock clock;
  Avoider avoider(
      {.planes = {.forecast = {&car, &harm}, .pace = runtime::Pace::real, .clock = &clock},
       .intent = &intent::shipped_model()});
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {30.0, 0.0}));
  Answer answer;
  for (int k = 0; k < 300 && !answer.begins; ++k) {
    answer = avoider.step(scene, clock.now());
    scene.time += 0.01;
    scene.ego.X_WB.p.x += 0.12;
  }
  EXPECT_EQ(answer.plan, manoeuvre::full_braking);
  EXPECT_EQ(avoider.finish(), "");
  EXPECT_THAT(events(avoider), HasSubstr("T1: 1.3"));
}

// A scene says 60 m/s in the instant in which braking begins. The brakes go by what the car
// measures: full braking takes 9.5 m, deployed at most 12 % more (docs/architecture.md), and 0.1 s
// to notice.
TEST(Avoider, BrakesInFullAfterAWrongSpeed) {
  Drive drive(12.0);
  Scene& scene = drive.scene();
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  bool begun = false;
  while (!begun && scene.time < 4.0) {
    const double left = 40.0 - 4.6 - scene.ego.X_WB.p.x;
    begun = drive
                .step([&] {
                  Scene wrong = scene;
                  wrong.ego.v_B.x = left < 12.0 * 1.35 ? 60.0 : scene.ego.v_B.x;
                  return drive.avoider().step(wrong);
                })
                .begins;
  }
  ASSERT_TRUE(begun);
  const double from = scene.ego.X_WB.p.x;
  for (int k = 0; k < 300; ++k) {
    (void)drive.step();
  }
  EXPECT_LT(norm(scene.ego.v_B), 0.1);
  EXPECT_LT(scene.ego.X_WB.p.x - from, 1.12 * 9.53);
}

/// A number of a scene, and what it may be.
struct Field {
  const char* name;
  double least;
  double most;
  std::function<double&(Scene&)> of;
};

double& given(std::optional<double>& number) {
  return number ? *number : number.emplace(0.0);
}

/// Every number of a scene but its road users', with the bounds of world::broken_rule.
std::vector<Field> scene_fields() {
  constexpr double any = std::numeric_limits<double>::max();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  return {
      {"time", -1e7, 1e7, [](Scene& s) -> double& { return s.time; }},
      {"ego x", -1e7, 1e7, [](Scene& s) -> double& { return s.ego.X_WB.p.x; }},
      {"ego y", -1e7, 1e7, [](Scene& s) -> double& { return s.ego.X_WB.p.y; }},
      {"ego yaw", -any, any, [](Scene& s) -> double& { return s.ego.X_WB.yaw; }},
      {"ego v x", -200.0, 200.0, [](Scene& s) -> double& { return s.ego.v_B.x; }},
      {"ego v y", -200.0, 200.0, [](Scene& s) -> double& { return s.ego.v_B.y; }},
      {"ego yaw rate", -100.0, 100.0, [](Scene& s) -> double& { return s.ego.yaw_rate; }},
      {"ego a x", -1e3, 1e3, [](Scene& s) -> double& { return s.ego.a_B.x; }},
      {"ego a y", -1e3, 1e3, [](Scene& s) -> double& { return s.ego.a_B.y; }},
      {"ego length", 1e-3, 1e3, [](Scene& s) -> double& { return s.ego_footprint.length; }},
      {"ego width", 1e-3, 1e3, [](Scene& s) -> double& { return s.ego_footprint.width; }},
      {"ego centre", -1e3, 1e3, [](Scene& s) -> double& { return s.ego_footprint.centre_x; }},
      {"ego mass", 1e-3, 1e7, [](Scene& s) -> double& { return s.ego_mass; }},
      {"grip", tiny, 1.2, [](Scene& s) -> double& { return s.grip; }},
      {"grip sd", 0.0, 1e7, [](Scene& s) -> double& { return s.grip_sd; }},
      {"road x", -1e7, 1e7, [](Scene& s) -> double& { return s.road.X_WL.p.x; }},
      {"road y", -1e7, 1e7, [](Scene& s) -> double& { return s.road.X_WL.p.y; }},
      {"road yaw", -any, any, [](Scene& s) -> double& { return s.road.X_WL.yaw; }},
      {"curvature", -1.0, 1.0, [](Scene& s) -> double& { return s.road.curvature; }},
      {"lane width", 1e-3, 1e3, [](Scene& s) -> double& { return s.road.lane_width; }},
      {"left edge", tiny, 1e7, [](Scene& s) -> double& { return s.road.left_edge; }},
      {"right edge", -1e7, -tiny, [](Scene& s) -> double& { return s.road.right_edge; }},
  };
}

/// Likewise of its first road user.
std::vector<Field> actor_fields() {
  constexpr double any = std::numeric_limits<double>::max();
  constexpr double right_angle = 0.5 * std::numbers::pi;
  const auto actor = [](auto&& of) {
    return [of](Scene& scene) -> double& { return of(scene.actors[0]); };
  };
  return {
      {"x", -1e7, 1e7, actor([](Actor& a) -> double& { return a.X_WA.p.x; })},
      {"y", -1e7, 1e7, actor([](Actor& a) -> double& { return a.X_WA.p.y; })},
      {"yaw", -any, any, actor([](Actor& a) -> double& { return a.X_WA.yaw; })},
      {"v x", -200.0, 200.0, actor([](Actor& a) -> double& { return a.v_W.x; })},
      {"v y", -200.0, 200.0, actor([](Actor& a) -> double& { return a.v_W.y; })},
      {"a x", -1e3, 1e3, actor([](Actor& a) -> double& { return a.a_W.x; })},
      {"a y", -1e3, 1e3, actor([](Actor& a) -> double& { return a.a_W.y; })},
      {"yaw rate", -100.0, 100.0, actor([](Actor& a) -> double& { return a.yaw_rate; })},
      {"length", 1e-3, 1e3, actor([](Actor& a) -> double& { return a.footprint.length; })},
      {"width", 1e-3, 1e3, actor([](Actor& a) -> double& { return a.footprint.width; })},
      {"centre", -1e3, 1e3, actor([](Actor& a) -> double& { return a.footprint.centre_x; })},
      {"mass", 1e-3, 1e7, actor([](Actor& a) -> double& { return a.mass; })},
      {"position sd", 0.0, 1e7, actor([](Actor& a) -> double& { return a.position_sd; })},
      {"velocity sd", 0.0, 1e7, actor([](Actor& a) -> double& { return a.velocity_sd; })},
      {"existence", 0.0, 1.0, actor([](Actor& a) -> double& { return a.existence; })},
      {"age", 0.0, 1e7, actor([](Actor& a) -> double& { return a.age; })},
      {"steering", -right_angle, right_angle,
       actor([](Actor& a) -> double& { return given(a.shared.steering); })},
      {"throttle", 0.0, 1.0, actor([](Actor& a) -> double& { return given(a.shared.throttle); })},
      {"brake", 0.0, 1.0, actor([](Actor& a) -> double& { return given(a.shared.brake); })},
  };
}

std::vector<Field> fields() {
  std::vector<Field> all = scene_fields();
  for (Field& one : actor_fields()) {
    all.push_back(std::move(one));
  }
  return all;
}

using Spoil = std::function<void(Scene&)>;

/// At 12 m/s good scenes towards a wreck, then, from this time to the conflict [s] on, one scene
/// spoilt in each of these ways, with thinking and forecasts; then good ones. Whatever they were,
/// the answers are valid, nothing is thrown, it is decided, and in the end the car stands. What
/// breaks a rule does not even make it brake later: it stops before the wreck. (What breaks none is
/// believed while it is seen.)
void expect_to_outlive(const std::vector<Spoil>& spoils, double begins) {
  Drive drive(12.0);
  Scene& scene = drive.scene();
  scene.actors.push_back(test::car(1, {26.0, 0.0}));
  const double conflict = (26.0 - 2.25 - 2.35) / 12.0;  // [s]
  auto next = spoils.begin();
  bool all_break_a_rule = true;
  bool begun = false;
  Answer answer;
  while (!(begun && next == spoils.end() && norm(scene.ego.v_B) < 0.1) && scene.time < 6.0) {
    const bool is_spoilt = scene.time > conflict - begins && next != spoils.end();
    answer = is_spoilt ? drive.step([&] {
      Scene spoilt = scene;
      (*next++)(spoilt);
      all_break_a_rule = all_break_a_rule && world::broken_rule(spoilt).has_value();
      return drive.avoider().step(spoilt);
    })
                       : drive.step();
    begun = begun || answer.begins;
  }
  EXPECT_TRUE(begun);
  EXPECT_FALSE(drive.step().degraded);
  EXPECT_LT(norm(scene.ego.v_B), 0.1);
  if (all_break_a_rule) {
    EXPECT_LT(scene.ego.X_WB.p.x + 2.35, 26.0 - 2.25) << "they touch";
  }
}

TEST(Avoider, OutlivesTheBoundsOfEveryNumber) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Field& field : fields()) {
    SCOPED_TRACE(field.name);
    const auto set_to = [&](double value) {
      return Spoil([&field, value](Scene& scene) { field.of(scene) = value; });
    };
    const std::vector<Spoil> within{set_to(field.least), set_to(field.most)};
    const std::vector<Spoil> beyond{set_to(std::nextafter(field.least, -infinity)),
                                    set_to(std::nextafter(field.most, infinity)), set_to(nan),
                                    set_to(infinity), set_to(-infinity)};
    ASSERT_NO_THROW(expect_to_outlive(beyond, 1.6));
    ASSERT_NO_THROW(expect_to_outlive(within, 1.6));
    ASSERT_NO_THROW(expect_to_outlive(within, 1.2));  // braking is under way
  }
}

TEST(Avoider, OutlivesWhatIsNoKindShapeOrName) {
  std::vector<Spoil> all;
  for (const std::uint8_t odd : {std::uint8_t{0}, std::uint8_t{6}, std::uint8_t{255}}) {
    all.insert(all.end(), {[odd](Scene& s) { s.actors[0].id = odd; },
                           [odd](Scene& s) { s.actors[0].kind = world::ActorKind{odd}; },
                           [odd](Scene& s) { s.actors[0].footprint.shape = world::Shape{odd}; },
                           [odd](Scene& s) { s.ego_footprint.shape = world::Shape{odd}; },
                           [odd](Scene& s) { s.road.topology = world::Topology{odd}; },
                           [odd](Scene& s) { s.road.left_beyond = world::Beyond{odd}; }});
  }
  ASSERT_NO_THROW(expect_to_outlive(all, 1.6));
  ASSERT_NO_THROW(expect_to_outlive(all, 1.2));
}

// At pace `real` nothing that is done on the driving thread takes memory.
TEST(Avoider, AllocatesNothingOnTheDrivingThread) {
  const manoeuvre::Car car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  SteadyClock clock;
  Avoider avoider({.planes = {.forecast = {&car, &harm},
                              .pace = runtime::Pace::real,
                              .clock = &clock,
                              .tape_size = 20 * runtime::Tape::step_size(1)},
                   .intent = &intent::shipped_model()});
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  const vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  const std::size_t before = num_allocations;
  bool begun = false;
  for (int k = 0; k < 300 && !begun; ++k) {
    begun = avoider.step(scene, clock.now()).begins;
    (void)avoider.control(state, 0.001);
    scene.time += 0.01;
    scene.ego.X_WB.p.x += 0.12;
  }
  EXPECT_EQ(num_allocations, before);
  EXPECT_TRUE(begun);
  EXPECT_EQ(avoider.finish(), "");
}

// Time jumps while forecaster and thinking plane are at work: each jump is a new drive.
TEST(Avoider, BeginsNewDrivesWhileOthersThink) {
  const manoeuvre::Car car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  SteadyClock clock;
  Avoider avoider(
      {.planes = {.forecast = {&car, &harm}, .pace = runtime::Pace::real, .clock = &clock},
       .intent = &intent::shipped_model()});
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {55.0, 0.0}));
  for (int k = 0; k < 60; ++k) {
    EXPECT_FALSE(avoider.step(scene, clock.now()).degraded);
    scene.time += k % 5 == 0 ? 2.0 : 0.01;
    clock.wait_until(clock.now() + from_seconds(0.002));
  }
  EXPECT_EQ(avoider.finish(), "");
  EXPECT_THAT(events(avoider), HasSubstr("a new drive begins"));
}

// Nor does any of it ask the system for anything: so says the kernel, which would end the process.
TEST(Avoider, MakesNoSystemCallOnTheDrivingThread) {
  const std::string why = why_system_calls_cannot_be_forbidden();
  if (!why.empty()) {
    GTEST_SKIP() << why;
  }
  const manoeuvre::Car car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  Scene scene = test::ego_at(12.0, manoeuvre::footprint(car));
  scene.ego_mass = car.mass;
  scene.actors.push_back(test::car(1, {40.0, 0.0}));
  const vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, scene.grip);
  EXPECT_EXIT(
      {
        SteadyClock clock;
        Avoider avoider(
            {.planes = {.forecast = {&car, &harm}, .pace = runtime::Pace::real, .clock = &clock},
             .intent = &intent::shipped_model()});
        forbid_system_calls();
        bool begun = false;
        for (int k = 0; k < 300; ++k) {
          begun = avoider.step(scene, clock.now()).begins || begun;
          (void)avoider.control(state, 0.001);
          scene.time += 0.01;
          scene.ego.X_WB.p.x += 0.12;
        }
        ::_exit(begun ? 0 : 3);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Avoider, NeedsWhatItIsMadeOf) {
  EXPECT_THROW(Avoider({}), ContractViolation);
}

}  // namespace
}  // namespace saca::avoider_test
