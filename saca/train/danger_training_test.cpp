#include "saca/train/danger_training.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "saca/core/contract.h"
#include "saca/core/file.h"
#include "saca/danger/disc_for_test.h"
#include "saca/danger/network.h"
#include "saca/danger/point_mass.h"

namespace saca::train::danger_training_test {
namespace {

namespace fs = std::filesystem;
using danger::Experience;

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
    danger::NetInputs inputs{};
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
  torch::Tensor inputs = torch::zeros({1, static_cast<std::int64_t>(danger::num_net_inputs)});
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
  auto nets = trained_danger(wall.experience(), quick(), 2, {}, every_point);
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
    return config::tensor_bytes(
        trained_danger(wall.experience(), plan, threads, {}, every_point).value()->tensors());
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
  const auto whole = trained_danger(wall.experience(), plan, 1, {}, every_point);
  int points = 0;
  const auto part = trained_danger(wall.experience(), plan, 1, state,
                                   [&](const DangerProgress&) { return ++points < 1; });
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(points, 1);
  std::vector<int> steps;
  const auto rest =
      trained_danger(wall.experience(), plan, 1, state, [&](const DangerProgress& point) {
        steps.push_back(point.step);
        return true;
      });
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(steps, (std::vector<int>{500, 1'000, 1'200}));
  EXPECT_EQ(config::tensor_bytes(rest.value()->tensors()),
            config::tensor_bytes(whole.value()->tensors()));

  plan.expectile = 0.95;
  const auto other = trained_danger(wall.experience(), plan, 1, state, every_point);
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().message.find("another training"), std::string::npos);
  ASSERT_FALSE(write_file(state, "no archive").has_value());
  const auto broken = trained_danger(wall.experience(), plan, 1, state, every_point);
  ASSERT_FALSE(broken.has_value());
  EXPECT_NE(broken.error().message.find("danger_training_state"), std::string::npos);
  fs::remove(state);
}

// Where it is known what inputs lead to, a small network finds the closed form.
TEST(DangerTraining, FittedIterationFindsTheValue) {
  torch::set_num_threads(1);
  const danger::DiscBeforeDisc discs;
  const danger::Outcomes outcomes =
      danger::point_mass_outcomes(discs.problem, discs.exact(), 6'000, 2);
  DangerPlan plan = quick();
  plan.steps = 2'000;
  plan.batch = 128;
  auto v = fitted_values(outcomes, plan, 2, {}, every_point);
  ASSERT_TRUE(v.has_value());
  DangerNet learnt = v.value();
  const auto told = [&](std::span<const reach::State> states) {
    std::vector<danger::SeenByNet> seen;
    for (const reach::State& at : states) {
      seen.push_back(seen_by_net(discs.problem, at));
    }
    return values_of(learnt, seen);
  };
  const danger::ValueErrors errors =
      danger::value_errors(discs.problem, discs.exact(), told, 25.0, 2'000, 8);
  EXPECT_LT(errors.mean_size, 0.25);
  EXPECT_GT(errors.same_sign, 0.93);
}

// What the product works out from the weights is what was trained.
TEST(DangerTraining, IsTheNetworkThatTheProductRuns) {
  torch::manual_seed(4);
  DangerNets nets(static_cast<std::int64_t>(danger::Network::width));
  const auto network = danger::Network::from(nets->tensors(), "weights");
  ASSERT_TRUE(network.has_value()) << network.error().message;
  danger::SeenByNet seen;
  seen.h = -3.0;
  seen.inputs.fill(0.3F);
  std::array<double, 1> v{};
  network.value().values({&seen, 1}, v);
  std::array<double, 1> q{};
  const manoeuvre::Demand demand{-0.5, 0.2};
  network.value().values_of(seen, {&demand, 1}, q);
  const torch::NoGradGuard none;
  const torch::Tensor inputs =
      torch::full({1, static_cast<std::int64_t>(danger::num_net_inputs)}, 0.3);
  const torch::Tensor h = torch::full({1}, -3.0);
  EXPECT_NEAR(v[0], nets->v(inputs, h).item<double>(), 1e-4);
  const torch::Tensor both = torch::cat({inputs, torch::tensor({{-0.5F, 0.2F}})}, 1);
  EXPECT_NEAR(q[0], torch::maximum(nets->q1(both, h), nets->q2(both, h)).item<double>(), 1e-4);
}

TEST(DangerTraining, WantsSomethingToLearnFrom) {
  EXPECT_THROW(std::ignore = trained_danger({}, quick(), 1, {}, every_point), ContractViolation);
}

}  // namespace
}  // namespace saca::train::danger_training_test
