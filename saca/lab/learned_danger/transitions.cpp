#include "saca/lab/learned_danger/transitions.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/acting.h"
#include "saca/lab/learned_danger/arc_evasions.h"
#include "saca/lab/learned_danger/exact.h"
#include "saca/lab/learned_danger/random.h"
#include "saca/thinking/danger/avoidance.h"
#include "saca/thinking/danger/car_limits.h"
#include "saca/thinking/danger/intrusion.h"

namespace saca::learned_danger {
namespace {

using manoeuvre::Demand;
using Obstacles = StaticVector<Obstacle, most_obstacles>;

/// The ego's drive, look by look; demands and poses lead from each look to the next.
struct Drive {
  double grip = 0.0;
  std::vector<Ego> looks;
  std::vector<Demand> demands;
  std::vector<PosesOnTheWay> ways;
};

class Maker {
 public:
  Maker(const manoeuvre::Car& car, const world::Footprint& body, const danger::DangerModel& model,
        const Mixture& mixture, std::uint64_t seed, const Network* network)
      : car_(car),
        limits_(danger::avoidance_of(car, 1.0)),
        body_(body),
        model_(model),
        mixture_(mixture),
        network_(network),
        random_(seed) {}

  void add_drive() {
    const double grip = uniform(random_, 0.2, 1.0);
    const DemandDrivenCar driven(car_, drawn_start(car_, grip, random_), grip);
    const State start{.ego = driven.ego(), .grip = grip};
    const Obstacles first = drawn_obstacles(start);
    const Drive drive = driven_by(drawn_behaviour(), driven, grip, first);
    add_situation(drive, 0, first);
    for (int i = 1; i < mixture_.situations; ++i) {
      constexpr int fewest = 5;  // looks that are left of the drive
      const int from =
          std::uniform_int_distribution<int>(0, std::max(0, mixture_.looks - fewest))(random_);
      const State seen{.ego = drive.looks[static_cast<std::size_t>(from)], .grip = grip};
      add_situation(drive, static_cast<std::size_t>(from), drawn_obstacles(seen));
    }
    ++made_.drives;
  }

  [[nodiscard]] Transitions take() { return std::move(made_); }

 private:
  Behaviour drawn_behaviour() {
    std::discrete_distribution<int> which(mixture_.behaviours.begin(), mixture_.behaviours.end());
    return static_cast<Behaviour>(which(random_));
  }

  Obstacles drawn_obstacles(const State& state) {
    const ArcEvasions arcs(limits_, body_, state);
    const auto can_stay_below = [&](double level, const Obstacle& obstacle) {
      const auto known = exact_value(model_, body_, state, obstacle);
      return known ? *known <= level : arcs.stay_below(level, obstacle);
    };
    const DrawnObstacles drawn =
        learned_danger::drawn_obstacles(body_, state, can_stay_below, mixture_.near_share, random_);
    made_.near += drawn.is_near ? 1 : 0;
    return drawn.obstacles;
  }

  /// What drives the point mass away from an obstacle: after what the table's value is least, and
  /// where there is none the best arc.
  [[nodiscard]] Demand evading(const State& state, const Obstacle& obstacle) const {
    const auto known = exact_best(model_, limits_, body_, state, obstacle);
    return known ? *known : ArcEvasions(limits_, body_, state).best(obstacle).demand;
  }

  static State at_look(const Ego& ego, double grip, const Obstacles& obstacles, double time) {
    State now{.ego = ego, .grip = grip, .obstacles = obstacles};
    move_obstacles(now, time);
    return now;
  }

  [[nodiscard]] Driver::Evasion evasion_from(const Obstacles& obstacles, double grip) const {
    return [this, obstacles, grip](const Ego& ego, double time) {
      const State now = at_look(ego, grip, obstacles, time);
      return network_ != nullptr ? least_q(*network_, body_, now) : evading(now, now.obstacles[0]);
    };
  }

  Drive driven_by(Behaviour behaviour, DemandDrivenCar driven, double grip,
                  const Obstacles& obstacles) {
    const Driver::Evasion evasion = evasion_from(obstacles, grip);
    Driver driver(behaviour, random_(), evasion);
    Drive drive{.grip = grip};
    drive.looks.push_back(driven.ego());
    for (int i = 0; i < mixture_.looks; ++i) {
      const Ego& now = drive.looks.back();
      if (mixture_.outcomes && is_settled(body_, at_look(now, grip, obstacles, look_step * i))) {
        break;
      }
      drive.demands.push_back(mixture_.outcomes ? evasion(now, look_step * i) : driver.next(now));
      drive.ways.push_back(driven.hold(drive.demands.back()));
      drive.looks.push_back(driven.ego());
    }
    return drive;
  }

  /// h between one look and the next, neither included.
  [[nodiscard]] double deepest_between(const PosesOnTheWay& way, State state) const {
    double deepest = -std::numeric_limits<double>::infinity();
    constexpr double between = look_step / static_cast<double>(poses_per_look);
    for (const Pose& pose : std::span(way).first<poses_per_look - 1>()) {
      move_obstacles(state, between);
      state.ego.X_WB = pose;
      deepest = std::max(deepest, intrusion(body_, state));
    }
    return deepest;
  }

  void add_situation(const Drive& drive, std::size_t from, const Obstacles& obstacles) {
    State now{.ego = drive.looks[from], .grip = drive.grip, .obstacles = obstacles};
    ++made_.situations;
    bool is_settled = learned_danger::is_settled(body_, now);
    double h_now = intrusion(body_, now);
    for (std::size_t i = from; i < drive.demands.size() && !is_settled; ++i) {
      State next{.ego = drive.looks[i + 1], .grip = drive.grip, .obstacles = now.obstacles};
      move_obstacles(next, look_step);
      is_settled = learned_danger::is_settled(body_, next);
      const double h_next = intrusion(body_, next);
      made_.add({.observation = observation(now),
                 .demand = drive.demands[i],
                 .h = std::max({h_now, deepest_between(drive.ways[i], now), h_next}),
                 .next_observation = observation(next),
                 .next_h = h_next,
                 .is_settled = is_settled,
                 .is_cut_off = !is_settled && i + 1 == drive.demands.size()});
      now = next;
      h_now = h_next;
    }
  }

  const manoeuvre::Car& car_;
  danger::Avoidance limits_;
  const world::Footprint& body_;
  const danger::DangerModel& model_;
  const Mixture& mixture_;
  const Network* network_;
  Random random_;
  Transitions made_;
};

}  // namespace

void Transitions::add(const Transition& one) {
  const auto append = [](std::vector<float>& rows, const Observation& row) {
    rows.insert(rows.end(), row.begin(), row.end());
  };
  append(observations, one.observation);
  append(next_observations, one.next_observation);
  actions.insert(actions.end(),
                 {static_cast<float>(one.demand.along), static_cast<float>(one.demand.across)});
  h.push_back(static_cast<float>(one.h));
  next_h.push_back(static_cast<float>(one.next_h));
  settled.push_back(one.is_settled ? 1.0F : 0.0F);
  cut_off.push_back(one.is_cut_off ? 1.0F : 0.0F);
  drive.push_back(static_cast<float>(drives));
}

Transitions made_transitions(const manoeuvre::Car& car, const world::Footprint& body,
                             const danger::DangerModel& model, const Mixture& mixture,
                             const DriveDraws& draws, const Network* network) {
  expects(draws.count >= 1 && mixture.looks >= 1 && mixture.situations >= 1,
          "at least one drive, look and situation");
  expects(mixture.near_share >= 0.0 && mixture.near_share <= 1.0, "a share in [0, 1]");
  expects(std::all_of(mixture.behaviours.begin(), mixture.behaviours.end(),
                      [](double share) { return share >= 0.0; }) &&
              std::accumulate(mixture.behaviours.begin(), mixture.behaviours.end(), 0.0) > 0.0,
          "shares of behaviours, not all 0");
  expects(!mixture.outcomes || network != nullptr, "a network whose outcomes are wanted");
  Maker maker(car, body, model, mixture, draws.seed, network);
  for (int i = 0; i < draws.count; ++i) {
    maker.add_drive();
  }
  return maker.take();
}

}  // namespace saca::learned_danger
