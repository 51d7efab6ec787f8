#include "saca/tune/trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/core/parallel.h"
#include "saca/core/units.h"
#include "saca/manoeuvre/draws.h"

namespace saca::tune {
namespace {

using manoeuvre::Car;
using manoeuvre::PolicyId;
using manoeuvre::Ride;
using vehicle::gravity;

struct Condition {
  double speed, grip;
};

world::Scene scene_at(const Condition& condition) {
  world::Scene scene;
  scene.ego.v_B = {condition.speed, 0.0};
  scene.grip = condition.grip;
  return scene;
}

// The start as it is when nobody drives exactly straight: to one side, then to the other.
world::Scene crooked(world::Scene scene, double side) {
  scene.ego.X_WB.yaw = side * from_degrees(2.0);
  scene.ego.yaw_rate = side * 0.08;
  return scene;
}

void add_twice(std::vector<Trial>& trials, const manoeuvre::Plan& plan, const Condition& condition,
               std::mt19937_64& rng) {
  const world::Scene scene = scene_at(condition);
  const double side = trials.size() % 4 < 2 ? 1.0 : -1.0;
  trials.push_back({plan, scene, {}});
  trials.push_back({plan, crooked(scene, side), manoeuvre::draw(rng)});
}

// A car whose domain refuses no drift.
Car without_domain(Car car) {
  car.tuning.domain.slowest.fill(1.0);
  return car;
}

// Longest that a drift may take: a stop with half of the grip, and a second to begin [s].
double longest_drift(const world::Scene& scene) {
  return 1.0 + 2.0 * scene.ego.v_B.x / (scene.grip * gravity);
}

double heading_error(const Pose& X_WB) {
  return std::abs(wrap_angle(X_WB.yaw - 0.5 * std::numbers::pi));
}

double squared(double x) {
  return x * x;
}

}  // namespace

std::vector<Trial> drift_trials(unsigned long seed) {
  constexpr std::array<Condition, 12> conditions{{{10, 0.9},
                                                  {12, 0.9},
                                                  {14, 0.9},
                                                  {16, 0.9},
                                                  {20, 0.9},
                                                  {25, 0.9},
                                                  {10, 0.5},
                                                  {14, 0.5},
                                                  {20, 0.5},
                                                  {12, 0.3},
                                                  {18, 0.3},
                                                  {14, 0.2}}};
  std::mt19937_64 rng(seed);
  std::vector<Trial> trials;
  for (const Condition& condition : conditions) {
    add_twice(trials, {PolicyId::t_drift_left, std::nullopt}, condition, rng);
  }
  return trials;
}

std::vector<Trial> swerve_trials(unsigned long seed) {
  constexpr std::array<Condition, 14> conditions{{{5, 0.9},
                                                  {8, 0.9},
                                                  {10, 0.9},
                                                  {14, 0.9},
                                                  {20, 0.9},
                                                  {25, 0.9},
                                                  {10, 0.5},
                                                  {17, 0.5},
                                                  {25, 0.5},
                                                  {8, 0.3},
                                                  {14, 0.3},
                                                  {22, 0.3},
                                                  {12, 0.2},
                                                  {20, 0.2}}};
  constexpr double slowest_braked = 8.0;  // [m/s]: at half of less, steering alone sets the time
  std::mt19937_64 rng(seed);
  std::vector<Trial> trials;
  for (const Condition& condition : conditions) {
    add_twice(trials, {PolicyId::aes_left, std::nullopt}, condition, rng);
    if (condition.speed >= slowest_braked) {
      add_twice(trials, {PolicyId::es_b_left, 0.5 * condition.speed}, condition, rng);
    }
  }
  return trials;
}

double drift_cost(const Car& car, const Trial& trial) {
  constexpr double most = 25.0;  // a heading 40 deg wrong, or worse
  const manoeuvre::Ending end = manoeuvre::ride_to_end(
      Ride(without_domain(car), trial.plan, trial.scene, trial.scene.grip, trial.unknown),
      longest_drift(trial.scene));
  if (!end.ended) {
    return 2.0 * most;
  }
  const double speed = trial.scene.ego.v_B.x;
  const double shortest = squared(speed) / (2.0 * trial.scene.grip * gravity);
  const double error = squared(heading_error(end.X_WB) / from_degrees(8.0));
  const double aside = squared(std::max(0.0, std::abs(end.X_WB.p.y) - 2.0) / 0.5);
  return std::min(error, most) + std::min(aside, most) + 10.0 * (end.X_WB.p.x / shortest - 1.0);
}

double swerve_cost(const Car& car, const Trial& trial) {
  constexpr double never = 10.0;
  constexpr double stays = 1.0;  // [s] for which it is watched after it has settled
  const double d = trial.scene.road.lane_width;
  const double ideal = 2.0 * std::sqrt(d / (trial.scene.grip * gravity));
  const double longest = 4.0 * ideal + stays;
  Ride ride(car, trial.plan, trial.scene, trial.scene.grip, trial.unknown);
  double settled = 0.0;
  double overshoot = 0.0;
  double time = 0.0;
  while (time < longest && time < settled + stays) {
    ride.step();
    time += vehicle::usual_step;
    const Pose& X_WB = ride.state().X_WB;
    if (std::abs(X_WB.p.y - d) > 0.2 || std::abs(X_WB.yaw) > from_degrees(2.0)) {
      settled = time;
    }
    overshoot = std::max(overshoot, X_WB.p.y - d);
  }
  return (settled + stays > longest ? never : settled / ideal) + squared(overshoot / 0.3);
}

double total_cost(const Car& car, const std::vector<Trial>& trials,
                  double (*cost)(const Car&, const Trial&), int threads) {
  std::vector<double> costs(trials.size());
  in_parallel(trials.size(), threads, [&](std::size_t i) { costs[i] = cost(car, trials[i]); });
  double sum = 0.0;
  for (const double one : costs) {
    sum += one;
  }
  return sum / static_cast<double>(costs.size()) +
         0.5 * *std::max_element(costs.begin(), costs.end());
}

int num_across(const Car& car, double speed, double grip, int count, unsigned long seed,
               int threads) {
  const manoeuvre::Plan plan{PolicyId::t_drift_left, std::nullopt};
  const world::Scene scene = scene_at({speed, grip});
  const auto endings = manoeuvre::draw_endings(without_domain(car), plan, scene, grip,
                                               longest_drift(scene), count, seed, 0, threads);
  return manoeuvre::num_across(endings, plan, scene.road);
}

manoeuvre::DriftDomain find_domain(const Car& car, int draws, unsigned long seed, int threads) {
  constexpr std::array<double, 14> speeds{25, 22.5, 20, 18, 16, 14, 12, 11, 10, 9, 8, 7, 6, 5};
  constexpr double nowhere = 100.0;  // no speed will do
  manoeuvre::DriftDomain domain{};
  for (std::size_t i = 0; i < domain.slowest.size(); ++i) {
    domain.slowest[i] = nowhere;
    for (const double speed : speeds) {
      const int across =
          num_across(car, speed, manoeuvre::DriftDomain::grips[i], draws, seed, threads);
      if (across < 0.95 * draws) {
        break;
      }
      domain.slowest[i] = speed;
    }
  }
  return domain;
}

}  // namespace saca::tune
