#include "saca/lab/eval/imitator.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "saca/lab/eval/methods.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/suite.h"

namespace saca::eval::imitator_test {
namespace {

using manoeuvre::PolicyId;

formats::Tensors some_tensors(std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<float> normal(0.0F, 0.3F);
  formats::Tensors all;
  const auto add = [&](const std::string& name, std::size_t rows, std::size_t columns) {
    formats::Tensor weight{{rows, columns}, std::vector<float>(rows * columns)};
    formats::Tensor bias{{rows}, std::vector<float>(rows)};
    for (auto* const numbers : {&weight.values, &bias.values}) {
      std::generate(numbers->begin(), numbers->end(), [&] { return normal(rng); });
    }
    all.tensors[name + ".weight"] = std::move(weight);
    all.tensors[name + ".bias"] = std::move(bias);
  };
  add("0", Imitator::width, num_imitator_inputs);
  add("1", Imitator::width, Imitator::width);
  add("2", manoeuvre::num_policies, Imitator::width);
  return all;
}

/// Straight along x, two lanes to the left, somebody coming from the left.
world::Scene crossing() {
  world::Scene scene;
  scene.ego_footprint = {.length = 4.5, .width = 1.8};
  scene.ego_mass = 1500.0;
  scene.grip = 0.8;
  scene.ego.v_B = {14.0, 0.3};
  scene.ego.X_WB = Pose{{0.0, 0.2}, 0.02};
  scene.ego.yaw_rate = 0.05;
  scene.road.left_edge = 5.25;
  scene.road.right_edge = -1.75;
  scene.road.left_beyond = world::Beyond::barrier;
  scene.road.oncoming_left = true;
  scene.actors.push_back({.id = 1,
                          .kind = world::ActorKind::truck,
                          .footprint = {.length = 8.0, .width = 2.5},
                          .mass = 9000.0,
                          .X_WA = Pose{{25.0, 9.0}, -1.4},
                          .v_W = {1.0, -7.0}});
  scene.actors.push_back({.id = 1,
                          .kind = world::ActorKind::pedestrian,
                          .footprint = {.length = 0.5, .width = 0.5},
                          .mass = 75.0,
                          .X_WA = Pose{{20.0, -3.0}, 1.5}});
  return scene;
}

/// Its image in the x axis.
world::Scene in_mirror(world::Scene scene) {
  const auto flip = [](Pose pose) { return Pose{{pose.p.x, -pose.p.y}, -pose.yaw}; };
  scene.ego.v_B.y *= -1.0;
  scene.ego.X_WB = flip(scene.ego.X_WB);
  scene.ego.yaw_rate *= -1.0;
  std::swap(scene.road.left_edge, scene.road.right_edge);
  scene.road.left_edge *= -1.0;
  scene.road.right_edge *= -1.0;
  std::swap(scene.road.left_beyond, scene.road.right_beyond);
  std::swap(scene.road.oncoming_left, scene.road.oncoming_right);
  for (world::Actor& actor : scene.actors) {
    actor.X_WA = flip(actor.X_WA);
    actor.v_W.y *= -1.0;
  }
  return scene;
}

TEST(ImitatorInputs, OfTheMirrorImageAreTheMirrored) {
  const ImitatorInputs there = imitator_inputs(in_mirror(crossing()));
  const ImitatorInputs mirror = mirrored(imitator_inputs(crossing()));
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_NEAR(there[i], mirror[i], 1e-6) << i;
  }
  EXPECT_EQ(mirrored(mirror), imitator_inputs(crossing()));
  EXPECT_NE(mirror, imitator_inputs(crossing()));
}

TEST(ImitatorInputs, AreThoseOfTheWorstAndZeroWhereNobodyIs) {
  world::Scene scene = crossing();
  const ImitatorInputs two = imitator_inputs(scene);
  const auto present = [](const ImitatorInputs& inputs, std::size_t k) {
    return inputs[num_ego_inputs + k * num_actor_inputs];
  };
  EXPECT_EQ(present(two, 1), 1.0F);
  EXPECT_EQ(present(two, 2), 0.0F);
  // The order in a scene means nothing, even where many threaten alike.
  for (int k = 2; k < 7; ++k) {
    world::Actor another = scene.actors[0];
    another.id = static_cast<std::uint8_t>(k);
    another.X_WA.p.x += 1.5 * k;
    scene.actors.push_back(another);
  }
  const ImitatorInputs seven = imitator_inputs(scene);
  EXPECT_EQ(present(seven, 3), 1.0F);
  for (std::size_t k = 0; k + 1 < scene.actors.size(); k += 2) {
    std::swap(scene.actors[k], scene.actors[scene.actors.size() - 1 - k / 2]);
    EXPECT_EQ(imitator_inputs(scene), seven) << k;
  }
  while (scene.actors.size() < world::max_actors) {
    world::Actor far = scene.actors[0];
    far.kind = world::ActorKind::van;
    far.id = static_cast<std::uint8_t>(scene.actors.size() + 1);
    far.X_WA.p = {-200.0, 60.0};
    scene.actors.push_back(far);
  }
  EXPECT_THAT(imitator_inputs(scene), testing::Each(testing::Truly([](float x) {
                return std::isfinite(x) && std::abs(x) < 100.0F;
              })));
  scene.actors.clear();
  EXPECT_EQ(present(imitator_inputs(scene), 0), 0.0F);
}

TEST(Imitator, ChoosesInTheMirrorWhatIsTheMirrorImage) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Imitator imitator = Imitator::from(some_tensors(seed), "weights").value();
    const auto p = imitator.probabilities(crossing());
    const auto there = imitator.probabilities(in_mirror(crossing()));
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, 1e-12);
    for (const PolicyId policy : manoeuvre::all_policies) {
      EXPECT_NEAR(p[manoeuvre::index(policy)], there[manoeuvre::index(mirrored(policy))], 1e-5);
    }
    const PolicyId choice = imitator.choice(crossing());
    EXPECT_EQ(p[manoeuvre::index(choice)], *std::max_element(p.begin(), p.end()));
  }
}

// All weights 0: each policy is as likely, and the mildest is chosen.
TEST(Imitator, OfEqualsTheMildestIsChosen) {
  formats::Tensors zero = some_tensors(1);
  for (auto& [name, tensor] : zero.tensors) {
    std::fill(tensor.values.begin(), tensor.values.end(), 0.0F);
  }
  const Imitator imitator = Imitator::from(zero, "zero").value();
  EXPECT_NEAR(imitator.probabilities(crossing())[3], 1.0 / 8.0, 1e-12);
  EXPECT_EQ(imitator.choice(crossing()), PolicyId::no_intervention);
}

TEST(Imitator, RefusesOtherTensors) {
  formats::Tensors wrong = some_tensors(1);
  wrong.tensors["1.bias"].shape = {3};
  wrong.tensors["1.bias"].values.resize(3);
  EXPECT_THAT(Imitator::from(wrong, "w.safetensors").error().message,
              testing::AllOf(testing::HasSubstr("w.safetensors"), testing::HasSubstr("1.bias")));
  wrong.tensors.erase("1.bias");
  EXPECT_FALSE(Imitator::from(wrong, "w").has_value());
  EXPECT_EQ(Imitator::read("models/imitator/none").error().code, Error::Code::unreadable);
}

// The shipped weights, at T1: a car stands where braking does not help and one side is free.
TEST(Imitator, IsAMethod) {
  const Imitators shipped{
      {"imitation", Imitator::read("models/imitator/compact_rwd_ev.safetensors").value()}};
  SteadyClock clock;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = shipped_harm();
  const SuiteRow row =
      run_encounter({.number = 0, .family = "made", .scenario = only_left_helps(), .twin = {}},
                    {.methods = {"imitation", "aeb"}, .imitators = &shipped, .exact = true},
                    {.forecast = {&car, &harm}, .clock = &clock}, intent::shipped_model());
  ASSERT_EQ(row.fault, "");
  const MethodRun& imitation = row.risk.runs[0];
  EXPECT_EQ(imitation.fault, "");
  ASSERT_TRUE(imitation.intervened());
  EXPECT_EQ(imitation.acted_at, row.risk.runs[1].acted_at);
}

}  // namespace
}  // namespace saca::eval::imitator_test
