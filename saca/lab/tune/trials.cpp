#include "saca/lab/tune/trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saca/base/core/parallel.h"
#include "saca/base/core/units.h"
#include "saca/lab/tune/draws.h"

namespace saca::tune {
namespace {

using manoeuvre::Car;
using manoeuvre::PolicyId;
using manoeuvre::Ride;
using vehicle::gravity;

struct Condition {
  double speed, grip;
  double bend = 0.0;  // share of the grip that the road takes, > 0 to the left
};

world::Scene scene_at(const Condition& condition) {
  world::Scene scene;
  scene.ego.v_B = {condition.speed, 0.0};
  scene.grip = condition.grip;
  scene.road.curvature =
      condition.bend * condition.grip * gravity / (condition.speed * condition.speed);
  scene.ego.yaw_rate = condition.speed * scene.road.curvature;
  return scene;
}

// The start as it is when nobody drives exactly straight.
world::Scene crooked(world::Scene scene, double side) {
  scene.ego.X_WB.yaw += side * from_degrees(2.0);
  scene.ego.yaw_rate += side * 0.08;
  return scene;
}

// Once as known, then with draws of what is not, crooked to one side and to the other in turn.
void add_trials(std::vector<Trial>& trials, const manoeuvre::Plan& plan, const Condition& condition,
                int draws, std::mt19937_64& rng) {
  const world::Scene scene = scene_at(condition);
  trials.push_back({plan, scene, {}});
  for (int i = 0; i < draws; ++i) {
    const double side = trials.size() % 2 == 0 ? 1.0 : -1.0;
    trials.push_back({plan, crooked(scene, side), manoeuvre::draw(rng)});
  }
}

// A car whose domain refuses no drift.
Car without_domain(Car car) {
  car.tuning.domain.slowest.fill(1.0);
  car.tuning.domain.fastest.fill(manoeuvre::fastest);
  return car;
}

// Longest that a drift may take: a stop with half of the grip, and a second to begin [s].
double longest_drift(const world::Scene& scene) {
  return 1.0 + 2.0 * scene.ego.v_B.x / (scene.grip * gravity);
}

double squared(double x) {
  return x * x;
}

}  // namespace

std::vector<Trial> drift_trials(unsigned long seed) {
  constexpr std::array<Condition, 11> conditions{{{10, 0.9},
                                                  {12, 0.9},
                                                  {14, 0.9},
                                                  {18, 0.9, -0.3},
                                                  {25, 0.9},
                                                  {10, 0.5},
                                                  {16, 0.5, 0.3},
                                                  {24, 0.5},
                                                  {12, 0.3},
                                                  {22, 0.3},
                                                  {18, 0.2}}};
  constexpr int draws = 3;
  std::mt19937_64 rng(seed);
  std::vector<Trial> trials;
  for (const Condition& condition : conditions) {
    add_trials(trials, {PolicyId::t_drift_left, std::nullopt}, condition, draws, rng);
  }
  return trials;
}

std::vector<Trial> swerve_trials(unsigned long seed) {
  constexpr std::array<Condition, 14> conditions{{{5, 0.9},
                                                  {8, 0.9},
                                                  {10, 0.9},
                                                  {14, 0.9},
                                                  {17, 0.9, 0.3},
                                                  {20, 0.9},
                                                  {25, 0.9},
                                                  {10, 0.5},
                                                  {17, 0.5, -0.3},
                                                  {25, 0.5},
                                                  {8, 0.3},
                                                  {20, 0.3},
                                                  {12, 0.2},
                                                  {20, 0.2}}};
  constexpr int draws = 2;
  constexpr double slowest_braked = 8.0;  // [m/s]
  std::mt19937_64 rng(seed);
  std::vector<Trial> trials;
  for (const Condition& condition : conditions) {
    add_trials(trials, {PolicyId::aes_left, std::nullopt}, condition, draws, rng);
    if (condition.speed >= slowest_braked) {
      add_trials(trials, {PolicyId::es_b_left, 0.5 * condition.speed}, condition, draws, rng);
    }
  }
  return trials;
}

double drift_cost(const Car& car, const Trial& trial) {
  constexpr double most = 25.0;  // a heading 40 deg wrong, or worse
  const tune::Ending end = tune::ride_to_end(
      Ride(without_domain(car), trial.plan, trial.scene, trial.scene.grip, trial.perturbation),
      longest_drift(trial.scene));
  if (!end.ended) {
    return 2.0 * most;
  }
  const double speed = trial.scene.ego.v_B.x;
  const double shortest = squared(speed) / (2.0 * trial.scene.grip * gravity);
  const double heading = world::to_lane(trial.scene.road, end.X_WB).heading;
  const Vec2 way_B = (inverse(trial.scene.ego.X_WB) * end.X_WB).p;  // from the start, as it went
  const double error = squared(wrap_angle(heading - 0.5 * std::numbers::pi) / from_degrees(8.0));
  const double aside = squared(std::max(0.0, std::abs(way_B.y) - 2.0) / 0.5);
  return std::min(error, most) + std::min(aside, most) + 16.0 * (way_B.x / shortest - 1.0);
}

double swerve_cost(const Car& car, const Trial& trial) {
  constexpr double never = 10.0;
  constexpr double stays = 1.0;        // [s] for which it is watched after it has settled
  constexpr double steepest = 0.4;     // sine of the largest direction against the lane
  constexpr double passed_at = 0.553;  // of the shortest time: 2.1 m of 3.5 m are done
  const world::Road& road = trial.scene.road;
  const double d = road.lane_width;
  const double slowest = trial.plan.target_speed.value_or(trial.scene.ego.v_B.x);
  const double shortest =
      std::max(2.0 * std::sqrt(d / (trial.scene.grip * gravity)), d / (steepest * slowest));
  const double longest = 4.0 * shortest + stays;
  Ride ride(car, trial.plan, trial.scene, trial.scene.grip, trial.perturbation);
  double settled = 0.0;
  double passed = 0.0;
  double overshoot = 0.0;
  double time = 0.0;
  while (time < longest && time < settled + stays) {
    ride.step();
    time += vehicle::usual_step;
    const world::LanePose pose = world::to_lane(road, ride.state().X_WB);
    if (std::abs(pose.d - d) > 0.2 || std::abs(pose.heading) > from_degrees(2.0)) {
      settled = time;
    }
    if (pose.d < 0.6 * d) {
      passed = time;
    }
    overshoot = std::max(overshoot, pose.d - d);
  }
  const double settling = settled + stays > longest ? never : settled / shortest;
  return 0.6 * settling + 0.4 * passed / (passed_at * shortest) + squared(overshoot / 0.3);
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
  const auto endings = tune::draw_endings(without_domain(car), plan, scene,
                                          {.grip = grip,
                                           .horizon = longest_drift(scene),
                                           .count = count,
                                           .seed = seed,
                                           .threads = threads});
  return tune::num_across(endings, plan, scene.road);
}

std::optional<manoeuvre::DriftDomain> find_domain(const Car& car, int draws, unsigned long seed,
                                                  int threads,
                                                  const std::function<bool()>& goes_on) {
  constexpr std::array<double, 14> speeds{5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 22.5, 25};
  manoeuvre::DriftDomain domain{};
  for (std::size_t i = 0; i < domain.slowest.size(); ++i) {
    // The longest row of speeds that all keep the promise.
    std::size_t best = 0;
    std::size_t row = 0;
    domain.slowest[i] = manoeuvre::fastest;  // and no faster than nothing: no speed will do
    domain.fastest[i] = 0.0;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
      if (!goes_on()) {
        return std::nullopt;
      }
      const double grip = manoeuvre::DriftDomain::grips[i];
      const bool kept = num_across(car, speeds[k], grip, draws, seed, threads) >= 0.95 * draws;
      row = kept ? row + 1 : 0;
      if (row > best) {
        best = row;
        domain.slowest[i] = speeds[k + 1 - row];
        domain.fastest[i] = speeds[k];
      }
    }
  }
  return domain;
}

}  // namespace saca::tune
