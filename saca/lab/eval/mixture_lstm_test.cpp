#include "saca/lab/eval/mixture_lstm.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "saca/thinking/intent/network_for_test.h"
#include "saca/thinking/intent/observed.h"
#include "tests/support/scenes.h"

namespace saca::eval::mixture_lstm_test {
namespace {

using testing::HasSubstr;

/// Random weights of the right shapes; `scale` 0: all outputs are 0.
formats::Tensors weights(float scale) {
  formats::Tensors tensors;
  intent::add_random_network(tensors, "", 3);
  std::mt19937 random(4);
  std::normal_distribution<float> normal(0.0F, 0.1F);
  constexpr std::size_t columns = 2 * intent::Encoder::width;
  std::vector<float> weight(MixtureModel::outputs_per_side * columns);
  std::vector<float> bias(MixtureModel::outputs_per_side);
  for (auto* const each : {&weight, &bias}) {
    for (float& number : *each) {
      number = scale * normal(random);
    }
  }
  tensors.tensors["output.weight"] = {{MixtureModel::outputs_per_side, columns}, weight};
  tensors.tensors["output.bias"] = {{MixtureModel::outputs_per_side}, bias};
  return tensors;
}

MixtureModel model(float scale = 1.0F) {
  return MixtureModel::from(weights(scale), "w").value();
}

// Way 1 of the world has the weight e of all six, an acceleration of 2 * 3 m/s2, 0.5 m/s to the
// left, and standard deviations that grow by 1 m/s along and e^-1 m/s across.
TEST(MixtureModel, OutputsAreReadAsTheHeaderHasThem) {
  MixtureModel::Outputs outputs{};
  double* const way = &outputs[0][1 * MixtureModel::outputs_per_way];
  way[0] = 1.0;
  for (std::size_t i = 0; i < forecast_times.size(); ++i) {
    way[1 + 4 * i] = 2.0;
    way[2 + 4 * i] = 0.5;
    way[3 + 4 * i] = 0.0;
    way[4 + 4 * i] = -1.0;
  }
  const LikelyPlaces places = places_of(outputs, 10.0, {});
  for (std::size_t i = 0; i < forecast_times.size(); ++i) {
    const double t = forecast_times[i];
    ASSERT_EQ(places[i].size(), 6U);
    EXPECT_NEAR(places[i][1].probability, std::numbers::e / (5.0 + std::numbers::e), 1e-12);
    EXPECT_NEAR(places[i][0].probability, 1.0 / (5.0 + std::numbers::e), 1e-12);
    EXPECT_NEAR(places[i][1].p_W.x, 10.0 * t + 3.0 * t * t, 1e-9);
    EXPECT_NEAR(places[i][1].p_W.y, 0.5 * t, 1e-9);
    EXPECT_NEAR(places[i][1].spread.along_sd, 0.1 + t, 1e-9);
    EXPECT_NEAR(places[i][1].spread.across_sd, 0.1 + t / std::numbers::e, 1e-9);
    EXPECT_NEAR(places[i][4].p_W.x, 10.0 * t, 1e-9);
  }
}

TEST(MixtureModel, IsSymmetricInTheMirror) {
  const MixtureModel random_model = model();
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  intent::Encoder::State state;
  intent::Encoder::State mirror_state;
  for (int k = 0; k < 10; ++k) {
    intent::Features features;
    for (float& each : features) {
      each = normal(random);
    }
    const auto places = places_of(random_model.step(features, state), 10.0, {});
    const auto mirror =
        places_of(random_model.step(intent::mirrored(features), mirror_state), 10.0, {});
    for (std::size_t i = 0; i < places.back().size(); ++i) {
      const LikelyPlace& one = places.back()[i];
      const LikelyPlace& other = mirror.back()[(i + 3) % 6];
      EXPECT_NEAR(one.probability, other.probability, 1e-9);
      EXPECT_NEAR(one.p_W.x, other.p_W.x, 1e-9);
      EXPECT_NEAR(one.p_W.y, -other.p_W.y, 1e-9);
      EXPECT_NEAR(one.spread.across_sd, other.spread.across_sd, 1e-9);
    }
  }
}

TEST(MixtureModel, OfOtherShapesIsRefused) {
  formats::Tensors tensors = weights(1.0F);
  tensors.tensors["output.bias"].shape = {2};
  tensors.tensors["output.bias"].values.resize(2);
  EXPECT_THAT(MixtureModel::from(tensors, "file").error().message,
              testing::AllOf(HasSubstr("file"), HasSubstr("output.bias")));
  tensors.tensors.erase("lstm.weight");
  EXPECT_THAT(MixtureModel::from(tensors, "file").error().message, HasSubstr("lstm.weight"));
  EXPECT_FALSE(MixtureModel::read("/nosuch/model.safetensors").has_value());
}

// With outputs of 0 everybody goes on at its speed, along its lane: on a road that turns by 0.01 /
// m, in the middle of the next lane, in either direction.
TEST(MixturePredictor, ForetellsAlongTheLane) {
  const MixtureModel zeros = model(0.0F);
  for (const double direction : {1.0, -1.0}) {
    world::Scene scene = test::ego_at(10.0);
    scene.road.curvature = 0.01;
    scene.road.left_edge = 5.25;
    const Pose X_WA = world::from_lane(scene.road, {.s = 40.0, .d = 3.5});
    const Vec2 v_W = direction * rotated({10.0, 0.0}, X_WA.yaw);
    scene.actors.push_back(test::car(1, X_WA.p, v_W));
    MixturePredictor predictor(zeros);
    predictor.look(scene);
    const LikelyPlaces places = predictor.places_of(scene, scene.actors[0]);
    for (const LikelyPlace& one : places.back()) {
      const world::LanePose at = world::to_lane(scene.road, {one.p_W, one.course});
      EXPECT_NEAR(at.d, 3.5, 1e-6);
      EXPECT_NEAR(at.s, 40.0 + direction * 30.0 / (1.0 - 0.01 * 3.5), 1e-6);
      EXPECT_NEAR(std::cos(at.heading), direction, 1e-9);
    }
  }
}

// It remembers: the same as the model stepped over what was observed.
TEST(MixturePredictor, StepsOverWhatIsObservedTenTimesASecond) {
  const MixtureModel random_model = model();
  MixturePredictor predictor(random_model);
  intent::ObservationHistory memory;
  intent::Encoder::State state;
  MixtureModel::Outputs outputs{};
  world::Scene scene;
  for (int k = 0; k <= 200; ++k) {  // 2 s of looks 10 ms apart
    const double t = 0.01 * k;
    scene = test::ego_at(20.0);
    scene.time = t;
    scene.actors.push_back(test::car(1, {40.0 + 15.0 * t, 0.3 * t}, {15.0, 0.3}));
    predictor.look(scene);
    if (k % 10 == 0) {
      memory.add(intent::observed(scene, 0));
      outputs = random_model.step(memory.features(), state);
    }
  }
  const world::Actor& car = scene.actors[0];
  const auto expected = places_of(outputs, 15.0, travel_line(scene, car));
  const auto predicted = predictor.places_of(scene, car);
  for (std::size_t i = 0; i < expected.back().size(); ++i) {
    EXPECT_NEAR(predicted.back()[i].p_W.x, expected.back()[i].p_W.x, 1e-9);
    EXPECT_NEAR(predicted.back()[i].probability, expected.back()[i].probability, 1e-12);
  }
}

TEST(MixturePredictor, WhoIsOnFootOrUnknownGoesStraight) {
  const MixtureModel random_model = model();
  MixturePredictor predictor(random_model);
  world::Scene scene = test::ego_at(10.0);
  scene.actors.push_back(test::car(1, {30.0, 5.0}, {1.0, 1.0}));
  scene.actors[0].kind = world::ActorKind::pedestrian;
  predictor.look(scene);
  scene.actors.push_back(test::car(2, {50.0, 0.0}, {10.0, 0.0}));
  for (const world::Actor& actor : scene.actors) {
    const auto places = predictor.places_of(scene, actor);
    ASSERT_EQ(places.back().size(), 1U);
    EXPECT_EQ(places.back()[0].p_W.x, going_straight(actor).back()[0].p_W.x);
  }
}

}  // namespace
}  // namespace saca::eval::mixture_lstm_test
