#include "saca/lab/network_training/danger_training.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/lab/learned_danger/disc_for_test.h"
#include "saca/lab/learned_danger/point_mass.h"

namespace saca::network_training::danger_training_test {
namespace {

namespace fs = std::filesystem;
using learned_danger::Experience;

constexpr std::size_t speed_input = 0;
constexpr std::size_t gap_input = 9;

const auto every_point = [](const DangerProgress&) { return true; };

/// A car before a wall, of which everything is known: with `gap` [m] left at `speed` [m/look], it
/// brakes by 1, goes on or speeds up by 1 in each look. h is minus the gap. Nothing happens after
/// it stands. What any demand leads to is in there, chosen at random.
class Wall {
 public:
  explicit Wall(int drives) {
    for (int i = 0; i < drives; ++i) {
      drive();
    }
  }
  [[nodiscard]] const Experience& experience() const { return all_; }

  /// Braking all the way: speed - 1, speed - 2, ... are driven until it stands.
  static double value(double gap, double speed) {
    double way = 0.0;
    for (double v = speed - 1.0; v > 0.0; v -= 1.0) {
      way += v;
    }
    return way - gap;
  }

 private:
  void add_state(double gap, double speed) {
    learned_danger::NetInputs inputs{};
    inputs[speed_input] = static_cast<float>(0.2 * speed);
    inputs[gap_input] = static_cast<float>(0.1 * gap);
    all_.inputs.insert(all_.inputs.end(), inputs.begin(), inputs.end());
    all_.h_at.push_back(static_cast<float>(-gap));
  }

  void drive() {
    std::uniform_int_distribution<int> any_speed(1, 5);
    std::uniform_real_distribution<double> any_gap(0.0, 14.0);
    std::uniform_int_distribution<int> any_change(-1, 1);
    double speed = any_speed(random_);
    double gap = any_gap(random_);
    const std::size_t start = all_.size();
    for (int look = 0; look < 12 && speed > 0.0 && gap > -6.0; ++look) {
      const double change = any_change(random_);
      all_.row.push_back(static_cast<std::uint32_t>(all_.num_states()));
      all_.next_row.push_back(all_.row.back() + 1);
      add_state(gap, speed);
      all_.actions.insert(all_.actions.end(), {static_cast<float>(change), 0.0F});
      speed = std::min(5.0, speed + change);
      gap -= speed;
      all_.h.push_back(static_cast<float>(-gap));
      all_.settled.push_back(speed == 0.0 ? 1.0F : 0.0F);
    }
    add_state(gap, speed);
    float reached = speed == 0.0 ? static_cast<float>(-gap) : Experience::end_not_seen;
    all_.reached.resize(all_.size());
    for (std::size_t i = all_.size(); i-- > start;) {
      reached = std::max(reached, all_.h[i]);
      all_.reached[i] = reached;
    }
  }

  std::mt19937_64 random_{5};
  Experience all_;
};

formats::Tensors tensors_of(const DangerNets& nets) {
  formats::Tensors all;
  nets->add_to(all, "");
  return all;
}

DangerPlan quick() {
  DangerPlan plan;
  plan.steps = 3'000;
  plan.batch = 512;
  plan.width = 32;
  plan.step = 3e-3;
  plan.polyak = 0.02;
  return plan;
}

torch::Tensor inputs_at(double gap, double speed) {
  torch::Tensor inputs =
      torch::zeros({1, static_cast<std::int64_t>(learned_danger::num_net_inputs)});
  inputs[0][static_cast<std::int64_t>(speed_input)] = 0.2 * speed;
  inputs[0][static_cast<std::int64_t>(gap_input)] = 0.1 * gap;
  return inputs;
}

torch::Tensor h_at(double gap) {
  return torch::full({1}, -gap);
}

// Nobody in the data brakes all the way from 5 more than once in 81 drives: V must be put together
// from pieces.
TEST(DangerTraining, FindsTheBestThatTheDataHolds) {
  torch::set_num_threads(1);
  const Wall wall(6'000);
  auto nets = trained_danger(wall.experience(), nullptr, quick(), 2, {}, every_point);
  ASSERT_TRUE(nets.has_value());
  DangerNets learnt = nets.value();
  const torch::NoGradGuard none;
  double sum = 0.0;
  int count = 0;
  for (int speed = 1; speed <= 5; ++speed) {
    for (double gap = 1.0; gap <= 12.0; gap += 1.0) {
      const double v = learnt->v(inputs_at(gap, speed), h_at(gap)).item<double>();
      sum += std::abs(v - Wall::value(gap, speed));
      ++count;
      EXPECT_NEAR(v, Wall::value(gap, speed), 1.2) << gap << " m at " << speed;
      const auto q = [&](double change) {
        const torch::Tensor action = torch::tensor({{change, 0.0}}, torch::kFloat32);
        return learnt->q1(torch::cat({inputs_at(gap, speed), action}, 1), h_at(gap)).item<double>();
      };
      if (speed < 5) {
        EXPECT_LT(q(-1.0), q(1.0)) << "braking is better, " << gap << " m at " << speed;
      }
    }
  }
  EXPECT_LT(sum / count, 0.35);
}

TEST(DangerTraining, IsTheSeedsWhateverTheThreads) {
  torch::set_num_threads(1);
  const Wall wall(200);
  DangerPlan plan = quick();
  plan.steps = 40;
  const auto bytes = [&](int threads) {
    return formats::tensor_bytes(tensors_of(
        trained_danger(wall.experience(), nullptr, plan, threads, {}, every_point).value()));
  };
  const std::string one = bytes(1);
  EXPECT_EQ(one, bytes(2));
  plan.seed = 2;
  EXPECT_NE(one, bytes(1));
}

TEST(DangerTraining, GoesOnWhereItWasStopped) {
  torch::set_num_threads(1);
  const Wall wall(200);
  DangerPlan plan = quick();
  plan.steps = 1'200;
  plan.batch = 32;
  const fs::path state = fs::path(testing::TempDir()) / "danger_training_state";
  fs::remove(state);
  const auto whole = trained_danger(wall.experience(), nullptr, plan, 1, {}, every_point);
  int points = 0;
  const auto part = trained_danger(wall.experience(), nullptr, plan, 1, state,
                                   [&](const DangerProgress&) { return ++points < 1; });
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(points, 1);
  std::vector<int> steps;
  const auto rest =
      trained_danger(wall.experience(), nullptr, plan, 1, state, [&](const DangerProgress& point) {
        steps.push_back(point.step);
        return true;
      });
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(steps, (std::vector<int>{500, 1'000, 1'200}));
  EXPECT_EQ(formats::tensor_bytes(tensors_of(rest.value())),
            formats::tensor_bytes(tensors_of(whole.value())));

  plan.expectile = 0.95;
  const auto other = trained_danger(wall.experience(), nullptr, plan, 1, state, every_point);
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().message.find("another training"), std::string::npos);
  ASSERT_FALSE(write_file(state, "no archive").has_value());
  const auto broken = trained_danger(wall.experience(), nullptr, plan, 1, state, every_point);
  ASSERT_FALSE(broken.has_value());
  EXPECT_NE(broken.error().message.find("danger_training_state"), std::string::npos);
  fs::remove(state);
}

// A state is of the networks that are learnt from, too: with others nobody goes on from it.
TEST(DangerTraining, DoesNotGoOnFromOtherNetworks) {
  torch::set_num_threads(1);
  const Wall wall(200);
  DangerPlan plan = quick();
  plan.steps = 1'000;
  plan.batch = 32;
  const fs::path state = fs::path(testing::TempDir()) / "danger_training_of_v_state";
  fs::remove(state);
  const learned_danger::Experience experience = wall.experience();
  const auto seeded = [](std::uint64_t seed) {
    torch::manual_seed(seed);
    return DangerNet(static_cast<std::int64_t>(learned_danger::num_net_inputs), 8);
  };
  const DangerNet one = seeded(1);
  plan.width = 8;
  ASSERT_TRUE(improved_q(experience, one, plan, 1, state, [](const DangerProgress&) {
                return false;
              }).has_value());
  const auto other = improved_q(experience, seeded(2), plan, 1, state, every_point);
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().message.find("another training"), std::string::npos);
  EXPECT_TRUE(improved_q(experience, one, plan, 1, state, every_point).has_value());
  fs::remove(state);
}

// Where it is known what inputs lead to, a small network finds the closed form.
TEST(DangerTraining, FittedIterationFindsTheValue) {
  torch::set_num_threads(1);
  const learned_danger::DiscBeforeDisc discs;
  const learned_danger::Outcomes outcomes =
      learned_danger::point_mass_outcomes(discs.problem, discs.exact(), 10'000, 2);
  DangerPlan plan = quick();
  plan.steps = 4'000;
  plan.batch = 128;
  auto v = fitted_values(outcomes, plan, 2, {}, every_point);
  ASSERT_TRUE(v.has_value());
  DangerNet learnt = v.value();
  const auto told = [&](std::span<const danger::State> states) {
    std::vector<learned_danger::SeenByNet> seen;
    for (const danger::State& at : states) {
      seen.push_back(seen_by_net(discs.problem, at));
    }
    return values_of(learnt, seen);
  };
  const learned_danger::ValueErrors errors =
      learned_danger::value_errors(discs.problem, discs.exact(), told, 25.0, 2'000, 8);
  EXPECT_LT(errors.mean_size, 0.25);
  EXPECT_GT(errors.same_sign, 0.93);
}

constexpr std::size_t side_input = 9;
constexpr std::size_t there_input = 22;

/// Somebody who comes from a side (1 or -1): after one look h is 1 if the ego moved to that side,
/// -1 if to the other; -14 whatever it does where he is far.
struct FromASide {
  float side;
  bool is_far = false;

  [[nodiscard]] learned_danger::NetInputs inputs() const {
    learned_danger::NetInputs all{};
    all[side_input] = side;
    all[there_input] = is_far ? 0.0F : 1.0F;
    return all;
  }
  [[nodiscard]] float h_at() const { return is_far ? -14.0F : -1.5F; }
  [[nodiscard]] float h_after(float moved) const { return is_far ? -14.0F : side * moved; }
};

/// Single looks beside these.
void add_look(Experience& all, const std::vector<FromASide>& obstacles, float moved) {
  all.row.push_back(static_cast<std::uint32_t>(all.num_states()));
  all.next_row.push_back(all.row.back() + 1);
  float h = -15.0F;
  for (int state = 0; state < 2; ++state) {
    for (const FromASide& one : obstacles) {
      const learned_danger::NetInputs inputs = one.inputs();
      all.inputs.insert(all.inputs.end(), inputs.begin(), inputs.end());
      all.h_at.push_back(state == 0 ? one.h_at() : one.h_after(moved));
      h = std::max(h, one.h_after(moved));
    }
  }
  all.actions.insert(all.actions.end(), {0.0F, moved});
  all.h.push_back(h);
  all.settled.push_back(1.0F);
  all.reached.push_back(h);
}

// Each can be evaded by itself, both together cannot; where one is far he adds nothing.
TEST(DangerTraining, LearnsThatTwoObstaclesMayBeMoreThanEach) {
  torch::set_num_threads(1);
  Experience singles{.num_obstacles = 1};
  Experience pairs{.num_obstacles = 2};
  for (int i = 0; i < 50; ++i) {
    for (const float moved : {-1.0F, 1.0F}) {
      for (const float side : {-1.0F, 1.0F}) {
        for (const bool is_far : {false, true}) {
          add_look(singles, {{side, is_far}}, moved);
          add_look(pairs, {{side}, {-side, is_far}}, moved);
          add_look(pairs, {{side}, {side, is_far}}, moved);
        }
      }
    }
  }
  DangerPlan plan = quick();
  plan.steps = 1'500;
  plan.batch = 64;
  DangerNets single = trained_danger(singles, nullptr, plan, 1, {}, every_point).value();
  const auto pair = trained_danger(pairs, &single, plan, 1, {}, every_point);
  ASSERT_TRUE(pair.has_value());
  const auto value = [&](const std::vector<FromASide>& obstacles) {
    std::vector<float> inputs;
    std::vector<float> h;
    for (const FromASide& one : obstacles) {
      const learned_danger::NetInputs row = one.inputs();
      inputs.insert(inputs.end(), row.begin(), row.end());
      h.push_back(one.h_at());
    }
    return joint_value(single, pair.value(),
                       torch::tensor(inputs).view({static_cast<std::int64_t>(h.size()), -1}),
                       torch::tensor(h));
  };
  EXPECT_NEAR(value({{1.0F}, {1.0F}}), -1.0, 0.3) << "from one side";
  EXPECT_NEAR(value({{1.0F}, {-1.0F}}), 1.0, 0.3) << "from both";
  EXPECT_NEAR(value({{-1.0F}, {1.0F}}), 1.0, 0.3);
  EXPECT_NEAR(value({{1.0F}, {-1.0F, true}}), -1.0, 0.3) << "he is far";
}

// Outcomes of somebody who only rolls are what rolling comes to, whatever else could be done.
TEST(DangerTraining, ValuesOfAPolicyAreWhatItsDrivesCameTo) {
  torch::set_num_threads(1);
  const auto rolled = [](double gap, double speed) { return 8.0 * speed - gap; };
  Experience outcomes;
  std::mt19937_64 random(3);
  for (int i = 0; i < 4'000; ++i) {
    const double speed = std::uniform_int_distribution<int>(1, 2)(random);
    const double gap = std::uniform_real_distribution<double>(0.0, 20.0)(random);
    outcomes.row.push_back(static_cast<std::uint32_t>(outcomes.num_states()));
    outcomes.next_row.push_back(outcomes.row.back() + 1);
    for (const double left : {gap, gap - speed}) {
      learned_danger::NetInputs inputs{};
      inputs[speed_input] = static_cast<float>(0.2 * speed);
      inputs[gap_input] = static_cast<float>(0.1 * left);
      outcomes.inputs.insert(outcomes.inputs.end(), inputs.begin(), inputs.end());
      outcomes.h_at.push_back(static_cast<float>(std::max(-15.0, -left)));
    }
    outcomes.actions.insert(outcomes.actions.end(), {0.0F, 0.0F});
    outcomes.h.push_back(static_cast<float>(std::max(-15.0, speed - gap)));
    outcomes.settled.push_back(0.0F);
    outcomes.reached.push_back(static_cast<float>(std::max(-15.0, rolled(gap, speed))));
  }
  outcomes.reached[0] = Experience::end_not_seen;
  DangerPlan plan = quick();
  plan.steps = 1'500;
  plan.batch = 256;
  auto nets = policy_values(outcomes, nullptr, plan, 1, {}, every_point);
  ASSERT_TRUE(nets.has_value());
  DangerNets learnt = nets.value();
  const torch::NoGradGuard none;
  for (double gap = 6.0; gap <= 10.0; gap += 1.0) {
    EXPECT_NEAR(learnt->v(inputs_at(gap, 1.0), h_at(gap)).item<double>(), rolled(gap, 1.0), 0.5);
  }
}

// Of drivers who always come a metre nearer than they are: one look by an input, then those.
TEST(DangerTraining, QIsOneLookAndThenWhatVIsOf) {
  torch::set_num_threads(1);
  const Wall wall(2'000);
  DangerPlan plan = quick();
  plan.steps = 1'500;
  DangerNet nearer(static_cast<std::int64_t>(learned_danger::num_net_inputs), plan.width);
  formats::Tensors weights;
  nearer->add_to(weights, "v.");
  for (auto& [name, tensor] : weights.tensors) {
    std::fill(tensor.values.begin(), tensor.values.end(), 0.0F);
  }
  weights.tensors["v.3.bias"].values[0] = std::log(std::exp(1.0F) - 1.0F);  // softplus of it is 1
  nearer->take(weights, "v.");
  auto nets = improved_q(wall.experience(), nearer, plan, 1, {}, every_point);
  ASSERT_TRUE(nets.has_value());
  DangerNets learnt = nets.value();
  const torch::NoGradGuard none;
  EXPECT_NEAR(learnt->v(inputs_at(5.0, 3.0), h_at(5.0)).item<double>(), -4.0, 1e-5) << "V stays";
  for (int speed = 1; speed <= 4; ++speed) {
    for (double gap = 4.0; gap <= 12.0; gap += 1.0) {
      for (const int change : {-1, 1}) {
        const torch::Tensor action =
            torch::tensor({{static_cast<float>(change), 0.0F}}, torch::kFloat32);
        const torch::Tensor q =
            torch::maximum(learnt->q1(torch::cat({inputs_at(gap, speed), action}, 1), h_at(gap)),
                           learnt->q2(torch::cat({inputs_at(gap, speed), action}, 1), h_at(gap)));
        const int then = speed + change;
        const double expected = then == 0 ? -gap : then - gap + 1.0;
        EXPECT_NEAR(q.item<double>(), expected, 0.4) << gap << " m at " << speed << ", " << change;
      }
    }
  }
}

TEST(DangerTraining, WantsSomethingToLearnFrom) {
  EXPECT_THROW(std::ignore = trained_danger({}, nullptr, quick(), 1, {}, every_point),
               ContractViolation);
}

}  // namespace
}  // namespace saca::network_training::danger_training_test
