#include "saca/onboard/reflex/saca_reflex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/onboard/reflex/encounter.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/vehicle_package.h"
#include "tests/support/count_allocations.h"

namespace saca::reflex::saca_reflex_test {
namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Struct>
Struct begun(void (*init)(Struct*)) {
  Struct one;
  init(&one);
  return one;
}

const collision::HarmModel& harm() {
  static const collision::HarmModel model = prepare::read_harm("data/harm.toml").value();
  return model;
}
std::string package_of(const manoeuvre::Car& car) {
  return vehicle_package_bytes(
      "a car", car, harm(),
      atlas_bytes(atlas::small_atlas_car(), atlas::small_grid(), atlas::small_nodes()));
}

class InC : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            (std::string("saca_c_") +
             testing::UnitTest::GetInstance()->current_test_info()->name() + ".vehicle");
    ASSERT_EQ(write_file(path_, package_of(atlas::small_atlas_car())), std::nullopt);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  struct Opened {
    saca_status status;
    std::unique_ptr<saca_reflex, void (*)(saca_reflex*)> reflex;
    std::string message;
  };
  [[nodiscard]] Opened open(std::int32_t version = SACA_REFLEX_VERSION) const {
    saca_reflex* reflex = nullptr;
    std::array<char, 500> message{};
    const saca_status status =
        saca_reflex_open(path_.c_str(), version, &reflex, message.data(), message.size());
    return {status, {reflex, saca_reflex_close}, message.data()};
  }

  std::filesystem::path path_;
};

/// A wide road; the ego where the small atlas knows what it does; a wreck ahead.
saca_scene wreck_ahead(double distance, double left) {
  auto scene = begun(saca_scene_init);
  scene.v_B.x = 12.5;
  scene.grip = 0.85;
  scene.road.lane_width = 3.2;
  scene.road.left_edge = 100.0;
  scene.road.right_edge = -100.0;
  scene.num_actors = 1;
  scene.actors[0].kind = SACA_OBSTACLE;
  scene.actors[0].X_WA.x = distance;
  scene.actors[0].X_WA.y = left;
  return scene;
}

/// What became of a drive on the model.
struct Driven {
  std::vector<saca_answer> answers;
  saca_measured last;
};
Driven drive(saca_reflex* reflex, saca_scene scene, double duration) {
  saca_model* model = nullptr;
  EXPECT_EQ(saca_model_open(reflex, &scene, &model), SACA_OK);
  Driven driven{{}, begun(saca_measured_init)};
  EXPECT_EQ(saca_model_measure(model, &driven.last), SACA_OK);
  auto command = begun(saca_command_init);
  for (int look = 0; 0.01 * look < duration; ++look) {
    auto answer = begun(saca_answer_init);
    EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_OK);
    driven.answers.push_back(answer);
    for (int k = 0; k < 10; ++k) {
      EXPECT_EQ(saca_reflex_control(reflex, &driven.last, 0.001, &command), SACA_OK);
      EXPECT_EQ(saca_model_step(model, &command, scene.grip, 0.001), SACA_OK);
      EXPECT_EQ(saca_model_measure(model, &driven.last), SACA_OK);
    }
    scene.time += 0.01;
    scene.X_WB = driven.last.X_WB;
    scene.v_B = driven.last.v_B;
    scene.a_B = driven.last.a_B;
    scene.yaw_rate = driven.last.yaw_rate;
  }
  saca_model_close(model);
  return driven;
}
const saca_answer* first_begun(const Driven& driven) {
  for (const saca_answer& answer : driven.answers) {
    if (answer.begins != 0) {
      return &answer;
    }
  }
  return nullptr;
}

TEST_F(InC, TellsItsVersionAndEachStatusInWords) {
  EXPECT_EQ(saca_reflex_version(), SACA_REFLEX_VERSION);
  for (saca_status status = SACA_OK; status <= SACA_FAILED; ++status) {
    EXPECT_THAT(saca_status_text(status), testing::Not(HasSubstr("no status")));
  }
  EXPECT_THAT(saca_status_text(SACA_FAILED + 1), HasSubstr("no status"));
  EXPECT_THAT(saca_status_text(-1), HasSubstr("no status"));
}

TEST_F(InC, OpensAPackage) {
  const auto opened = open();
  EXPECT_EQ(opened.status, SACA_OK) << opened.message;
  EXPECT_STREQ(saca_reflex_car_name(opened.reflex.get()), "a car");
  EXPECT_STREQ(saca_reflex_broken_rule(opened.reflex.get()), "");
}

TEST_F(InC, SaysWhyAPackageCannotBeUsed) {
  const auto other = open(SACA_REFLEX_VERSION + 1);
  EXPECT_EQ(other.status, SACA_OTHER_VERSION);
  EXPECT_THAT(other.message, HasSubstr("want version 1 of saca_reflex.h, got 2"));
  EXPECT_EQ(other.reflex, nullptr);

  std::filesystem::resize_file(path_, 5'000);
  const auto cut = open();
  EXPECT_EQ(cut.status, SACA_MALFORMED);
  EXPECT_THAT(cut.message, HasSubstr(path_.filename().string()));

  manoeuvre::Car heavier = atlas::small_atlas_car();
  heavier.mass += 100.0;
  ASSERT_EQ(write_file(path_, package_of(heavier)), std::nullopt);
  const auto wrong = open();
  EXPECT_EQ(wrong.status, SACA_OTHER_CAR) << wrong.message;

  std::filesystem::remove(path_);
  const auto gone = open();
  EXPECT_EQ(gone.status, SACA_UNREADABLE);
  std::array<char, 8> little{};
  saca_reflex* none = nullptr;
  EXPECT_EQ(saca_reflex_open(path_.c_str(), SACA_REFLEX_VERSION, &none, little.data(), 8),
            SACA_UNREADABLE);
  EXPECT_EQ(std::string(little.data()), gone.message.substr(0, 7));
  EXPECT_EQ(saca_reflex_open(path_.c_str(), SACA_REFLEX_VERSION, &none, nullptr, 0),
            SACA_UNREADABLE);
}

TEST_F(InC, RefusesNullAndStructsOfAnotherSize) {
  const auto opened = open();
  saca_reflex* const reflex = opened.reflex.get();
  auto scene = begun(saca_scene_init);
  auto answer = begun(saca_answer_init);
  auto measured = begun(saca_measured_init);
  auto command = begun(saca_command_init);
  EXPECT_EQ(saca_reflex_open(nullptr, 1, nullptr, nullptr, 0), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_step(nullptr, &scene, &answer), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_step(reflex, nullptr, &answer), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_step(reflex, &scene, nullptr), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_miss(nullptr, 0.0, &answer), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_control(nullptr, &measured, 0.001, &command), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_control(reflex, &measured, 0.0, &command), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_control(reflex, &measured, nan, &command), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_reflex_stand_down(nullptr), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_model_open(reflex, &scene, nullptr), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_model_step(nullptr, &command, 0.9, 0.001), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_model_measure(nullptr, &measured), SACA_BAD_ARGUMENT);
  saca_reflex_close(nullptr);
  saca_model_close(nullptr);
  EXPECT_STREQ(saca_reflex_car_name(nullptr), "");

  scene.num_actors = SACA_MAX_ACTORS + 1;
  EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_BAD_ARGUMENT);
  scene.num_actors = 0;
  scene.size -= 8;
  EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_OTHER_VERSION);
  scene.size += 8;
  answer.size = 0;
  EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_OTHER_VERSION);
  measured.size = 0;
  EXPECT_EQ(saca_reflex_control(reflex, &measured, 0.001, &command), SACA_OTHER_VERSION);
}

TEST_F(InC, StopsBeforeAWreck) {
  const auto opened = open();
  const Driven driven = drive(opened.reflex.get(), wreck_ahead(40.0, 0.0), 6.0);
  const saca_answer* const begun_with = first_begun(driven);
  ASSERT_NE(begun_with, nullptr);
  EXPECT_EQ(begun_with->triggered, 1);
  EXPECT_EQ(begun_with->threat_kind, SACA_OBSTACLE);
  EXPECT_EQ(begun_with->threat_id, 1);
  EXPECT_LT(begun_with->time_to_conflict, 1.31);
  EXPECT_EQ(begun_with->plan.policy, SACA_AEB);
  const double reach = atlas::small_atlas_car().front_end + 4.5 / 2.0;
  EXPECT_EQ(driven.last.v_B.x, 0.0);
  EXPECT_LT(driven.last.X_WB.x + reach, 40.0);
  const auto over =
      std::find_if(driven.answers.begin(), driven.answers.end(),
                   [](const saca_answer& answer) { return answer.encounter_is_over != 0; });
  ASSERT_NE(over, driven.answers.end());
  EXPECT_EQ(std::prev(over)->carries_out, 1) << "the brakes hold until the encounter is over";
  EXPECT_EQ(over->carries_out, 0);
}

// The same wreck, half across the lane from either side: what is done is the other's mirror image.
TEST_F(InC, DrivesMirrorImages) {
  std::array<saca_measured, 2> last{};
  std::array<saca_plan, 2> plans{};
  for (const std::size_t side : {0U, 1U}) {
    const auto opened = open();
    auto scene = wreck_ahead(12.0, side == 0 ? 0.9 : -0.9);  // too late to stop
    const Driven driven = drive(opened.reflex.get(), scene, 1.5);
    ASSERT_NE(first_begun(driven), nullptr);
    plans[side] = first_begun(driven)->plan;
    last[side] = driven.last;
  }
  EXPECT_THAT(plans[0].policy, testing::AnyOf(SACA_AES_RIGHT, SACA_ES_B_RIGHT));
  EXPECT_EQ(plans[1].policy, plans[0].policy - 1) << "the same to the left";
  EXPECT_NEAR(last[0].X_WB.x, last[1].X_WB.x, 1e-9);
  EXPECT_NEAR(last[0].X_WB.y, -last[1].X_WB.y, 1e-9);
  EXPECT_NEAR(last[0].X_WB.yaw, -last[1].X_WB.yaw, 1e-9);
}

/// A scene in which each number says something.
saca_scene telling_scene() {
  auto scene = wreck_ahead(22.0, 0.4);
  scene.X_WB = {3.0, 1.0, 0.02};
  scene.v_B = {12.4, 0.1};
  scene.a_B = {-0.2, 0.3};
  scene.yaw_rate = 0.01;
  scene.grip_sd = 0.05;
  scene.road.topology = SACA_INTERSECTION;
  scene.road.X_WL = {0.0, 1.1, 0.01};
  scene.road.curvature = 0.001;
  scene.road.left_edge = 9.0;
  scene.road.right_edge = -7.0;
  scene.road.left_beyond = SACA_TREES;
  scene.road.right_beyond = SACA_KERB;
  scene.road.oncoming_left = 1;
  scene.num_actors = 2;
  scene.actors[0] = {.kind = SACA_TRUCK,
                     .id = 7,
                     .shape = SACA_ELLIPSE,
                     .is_occluded = 1,
                     .length = 9.0,
                     .width = 2.5,
                     .mass = 9'000.0,
                     .X_WA = {22.0, 1.4, 0.1},
                     .v_W = {2.0, 0.2},
                     .a_W = {-0.5, 0.1},
                     .yaw_rate = 0.02,
                     .position_sd = 0.3,
                     .velocity_sd = 0.4,
                     .existence = 0.9,
                     .age = 0.05};
  scene.actors[1].id = 2;
  scene.actors[1].X_WA = {-15.0, 1.0, 0.0};
  scene.actors[1].v_W = {13.0, 0.0};
  return scene;
}

/// The same as the classes are given it.
world::Scene same_scene(const manoeuvre::Car& car) {
  world::Scene same;
  same.ego = {.X_WB = {{3.0, 1.0}, 0.02}, .v_B = {12.4, 0.1}, .yaw_rate = 0.01, .a_B = {-0.2, 0.3}};
  same.ego_footprint = manoeuvre::footprint(car);
  same.ego_mass = car.mass;
  same.grip = 0.85;
  same.grip_sd = 0.05;
  same.road = {.topology = world::Topology::intersection,
               .X_WL = {{0.0, 1.1}, 0.01},
               .curvature = 0.001,
               .lane_width = 3.2,
               .left_edge = 9.0,
               .right_edge = -7.0,
               .left_beyond = world::Beyond::trees,
               .right_beyond = world::Beyond::kerb,
               .oncoming_left = true};
  world::Actor truck{.id = 7,
                     .kind = world::ActorKind::truck,
                     .footprint = {world::Shape::ellipse, 9.0, 2.5},
                     .mass = 9'000.0,
                     .X_WA = {{22.0, 1.4}, 0.1},
                     .v_W = {2.0, 0.2},
                     .a_W = {-0.5, 0.1},
                     .yaw_rate = 0.02,
                     .position_sd = 0.3,
                     .velocity_sd = 0.4,
                     .existence = 0.9,
                     .age = 0.05,
                     .occluded = true};
  same.actors.push_back(truck);
  world::Actor follower{.id = 2, .footprint = {.length = 4.5, .width = 1.8}, .mass = 1'500.0};
  follower.X_WA.p = {-15.0, 1.0};
  follower.v_W = {13.0, 0.0};
  same.actors.push_back(follower);
  return same;
}

saca_measured measured_of(const vehicle::VehicleState& state) {
  auto measured = begun(saca_measured_init);
  measured.X_WB = telling_scene().X_WB;
  measured.v_B = {state.v_B.x, state.v_B.y};
  measured.a_B = {state.a_B.x, state.a_B.y};
  measured.yaw_rate = state.yaw_rate;
  measured.steering = state.steering;
  std::copy(state.wheel_speed.begin(), state.wheel_speed.end(), measured.wheel_speed);
  std::copy(state.brake_torque.begin(), state.brake_torque.end(), measured.brake_torque);
  measured.motor_torque = state.motor_torque;
  measured.load_a_B = {-0.1, 0.2};
  return measured;
}

// Field for field what the classes are given.
TEST_F(InC, SaysWhatTheClassesSay) {
  const auto opened = open();
  const auto package = read_vehicle_package(path_);
  ASSERT_TRUE(package.has_value());
  const manoeuvre::Car& car = package.value().car;
  ReflexPlane plane({.car = &car, .atlas = AtlasJudge(car, package.value().atlas, harm())});
  const auto scene = telling_scene();
  const world::Scene same = same_scene(car);
  auto answer = begun(saca_answer_init);
  ASSERT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
  const Reflex wanted = plane.step(same);
  ASSERT_TRUE(wanted.triggered);
  EXPECT_EQ(answer.triggered, 1);
  EXPECT_EQ(answer.threat_kind, SACA_TRUCK);
  EXPECT_EQ(answer.threat_id, 7);
  EXPECT_EQ(answer.time_to_conflict, wanted.threat->time);
  EXPECT_EQ(answer.plan.policy, static_cast<int>(wanted.plan.policy));
  EXPECT_EQ(answer.plan.strength, manoeuvre::strength_of(wanted.plan));
  EXPECT_EQ(std::isnan(answer.plan.target_speed), !wanted.plan.target_speed.has_value());

  manoeuvre::Execution execution(car, wanted.plan, same);
  vehicle::VehicleState state = manoeuvre::rolling_state(car, same.ego, same.grip);
  state.transfer_a_B = {-0.1, 0.2};
  const auto measured = measured_of(state);
  auto command = begun(saca_command_init);
  ASSERT_EQ(saca_reflex_control(opened.reflex.get(), &measured, 0.001, &command), SACA_OK);
  const vehicle::Command told = execution.control(state, same.grip, 0.001);
  EXPECT_EQ(command.steering, told.steering);
  EXPECT_EQ(command.motor_torque, told.motor_torque);
  for (std::size_t wheel = 0; wheel < vehicle::num_wheels; ++wheel) {
    EXPECT_EQ(command.brake_torque[wheel], told.brake_torque[wheel]);
  }
}

TEST_F(InC, LeavesOutAnActorThatIsNone) {
  for (const bool by_kind : {true, false}) {
    const auto opened = open();
    auto scene = wreck_ahead(15.0, 0.0);
    (by_kind ? scene.actors[0].kind : scene.actors[0].id) = by_kind ? 7 : 256;
    auto answer = begun(saca_answer_init);
    EXPECT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
    EXPECT_EQ(answer.threatened, 0);
    EXPECT_THAT(saca_reflex_broken_rule(opened.reflex.get()), HasSubstr("an actor's kind is"));
  }
}

TEST_F(InC, TakesSecondsSince1970) {
  const auto opened = open();
  auto scene = wreck_ahead(15.0, 0.0);
  scene.time = 1.8e9;
  auto answer = begun(saca_answer_init);
  EXPECT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
  EXPECT_EQ(answer.threatened, 1);
  EXPECT_STREQ(saca_reflex_broken_rule(opened.reflex.get()), "");
  saca_model* model = nullptr;
  EXPECT_EQ(saca_model_open(opened.reflex.get(), &scene, &model), SACA_OK);
  saca_model_close(model);

  scene.time = 2e10;
  EXPECT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
  EXPECT_EQ(answer.degraded, 1) << "carried on";
  EXPECT_THAT(saca_reflex_broken_rule(opened.reflex.get()), HasSubstr("the time"));
}

TEST_F(InC, LeavesALateSceneAside) {
  const auto opened = open();
  auto scene = wreck_ahead(60.0, 0.0);
  scene.time = 10.0;
  auto answer = begun(saca_answer_init);
  ASSERT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
  scene.time = 9.5;
  EXPECT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_BAD_SCENE);
  EXPECT_STREQ(saca_reflex_broken_rule(opened.reflex.get()), "");
}

TEST_F(InC, CarriesOnForHalfASecondWhateverComes) {
  const auto opened = open();
  saca_reflex* const reflex = opened.reflex.get();
  auto scene = wreck_ahead(20.0, 0.0);
  auto answer = begun(saca_answer_init);
  EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_OK);
  ASSERT_EQ(answer.begins, 1);
  const std::int32_t policy = answer.plan.policy;
  scene.time = 0.1;
  scene.road.left_beyond = 4;
  EXPECT_EQ(saca_reflex_step(reflex, &scene, &answer), SACA_OK);
  EXPECT_EQ(answer.degraded, 1);
  EXPECT_THAT(saca_reflex_broken_rule(reflex), HasSubstr("the road"));
  EXPECT_EQ(saca_reflex_miss(reflex, 0.2, &answer), SACA_OK);
  EXPECT_EQ(answer.degraded, 1);
  EXPECT_EQ(saca_reflex_miss(reflex, 0.7, &answer), SACA_BAD_SCENE);
  EXPECT_EQ(answer.carries_out, 1) << "what is under way goes on";
  EXPECT_EQ(answer.plan.policy, policy);
  EXPECT_EQ(saca_reflex_stand_down(reflex), SACA_OK);
  EXPECT_EQ(saca_reflex_miss(reflex, 0.8, &answer), SACA_BAD_SCENE);
  EXPECT_EQ(answer.carries_out, 0);
  EXPECT_EQ(answer.plan.policy, SACA_NO_INTERVENTION);
}

TEST_F(InC, AModelRefusesWhatNoCarIsTold) {
  const auto opened = open();
  auto scene = wreck_ahead(20.0, 0.0);
  saca_model* model = nullptr;
  scene.v_B.x = nan;
  EXPECT_EQ(saca_model_open(opened.reflex.get(), &scene, &model), SACA_BAD_SCENE);
  EXPECT_EQ(model, nullptr);
  scene.v_B.x = 10.0;
  ASSERT_EQ(saca_model_open(opened.reflex.get(), &scene, &model), SACA_OK);
  auto command = begun(saca_command_init);
  EXPECT_EQ(saca_model_step(model, &command, 0.9, 0.1), SACA_BAD_ARGUMENT);
  EXPECT_EQ(saca_model_step(model, &command, nan, 0.001), SACA_BAD_ARGUMENT);
  command.brake_torque[2] = -1.0;
  EXPECT_EQ(saca_model_step(model, &command, 0.9, 0.001), SACA_BAD_ARGUMENT);
  saca_model_close(model);
}

TEST_F(InC, AllocatesNothingOnceOpen) {
  const auto opened = open();
  auto scene = wreck_ahead(18.0, 0.5);
  auto answer = begun(saca_answer_init);
  auto measured = begun(saca_measured_init);
  auto command = begun(saca_command_init);
  measured.v_B.x = 12.5;
  const std::size_t before = num_allocations;
  for (int look = 0; look < 5; ++look) {
    scene.time = 0.05 * look;
    EXPECT_EQ(saca_reflex_step(opened.reflex.get(), &scene, &answer), SACA_OK);
    EXPECT_EQ(saca_reflex_control(opened.reflex.get(), &measured, 0.001, &command), SACA_OK);
  }
  EXPECT_EQ(saca_reflex_miss(opened.reflex.get(), 0.3, &answer), SACA_OK);
  EXPECT_EQ(num_allocations, before);
  EXPECT_EQ(answer.carries_out, 1);
}

}  // namespace
}  // namespace saca::reflex::saca_reflex_test
