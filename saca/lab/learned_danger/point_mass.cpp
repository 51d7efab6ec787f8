#include "saca/lab/learned_danger/point_mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/learned_danger/behaviour.h"
#include "saca/lab/learned_danger/random.h"
#include "saca/lab/learned_danger/state.h"
#include "saca/onboard/manoeuvre/demand.h"
#include "saca/onboard/vehicle/vehicle.h"
#include "saca/thinking/danger/follow.h"
#include "saca/thinking/danger/intrusion.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::learned_danger {
namespace {

using manoeuvre::Demand;

constexpr double near_boundary = 2.0;  // [m]

/// The same as a state of the full vehicle that neither turns nor accelerates yet.
State as_seen(const PointMass& problem, const danger::State& at) {
  State state;
  state.ego.X_WB = {{at[0], at[1]}, at[2]};
  state.ego.v_B = {at[3], 0.0};
  state.grip = problem.system.grip;
  state.obstacles.push_back({.body = problem.obstacle});
  return state;
}

double intrusion_at(const PointMass& problem, const danger::State& at) {
  return danger::intrusion(problem.ego, {{at[0], at[1]}, at[2]}, problem.obstacle, Pose{});
}

danger::Acceleration acceleration_of(const PointMass& problem, const Demand& demand) {
  const double most = problem.system.grip * vehicle::gravity;
  return {most * demand.along, most * demand.across};
}

/// One look: where it ends, and how deep on the way.
struct Look {
  danger::State end{};
  double deepest = 0.0;  ///< both ends included [m]
};

Look driven_look(const PointMass& problem, const danger::State& from, const Demand& demand) {
  constexpr double between = look_step / static_cast<double>(poses_per_look);
  Look look{.end = from, .deepest = intrusion_at(problem, from)};
  const danger::Acceleration input = acceleration_of(problem, demand);
  for (std::size_t i = 0; i < poses_per_look; ++i) {
    look.end = danger::driven(problem.system, look.end, input, between);
    look.deepest = std::max(look.deepest, intrusion_at(problem, look.end));
  }
  return look;
}

/// Any state apart from the obstacle whose value is known.
danger::State drawn_state(const PointMass& problem, const danger::ValueAt& exact, double fastest,
                          Random& random) {
  constexpr double most_distant = 60.0;  // [m]
  for (;;) {
    const double distance = uniform(random, 0.0, most_distant);
    const double bearing = uniform(random, -std::numbers::pi, std::numbers::pi);
    const double aside = uniform(random, -1.0, 1.0);  // of the course from the way to the obstacle
    const double course =
        wrap_angle(bearing + std::numbers::pi + std::numbers::pi * aside * std::abs(aside));
    const danger::State at{distance * std::cos(bearing), distance * std::sin(bearing), course,
                           uniform(random, 0.0, fastest)};
    if (exact(at).inside && intrusion_at(problem, at) < 0.0) {
      return at;
    }
  }
}

danger::State drawn_near_boundary(const PointMass& problem, const danger::ValueAt& exact,
                                  double fastest, Random& random) {
  for (;;) {
    const danger::State at = drawn_state(problem, exact, fastest, random);
    if (std::abs(exact(at).value) < near_boundary) {
      return at;
    }
  }
}

class PointMassDrives {
 public:
  PointMassDrives(const PointMass& problem, const danger::ValueAt& exact, std::uint64_t seed)
      : problem_(problem),
        random_(seed),
        exact_(exact),
        best_(danger::by_look_ahead(
            problem.system, [&exact](const danger::State& at) { return exact(at).value; }, 0.2)) {}

  void add_drive() {
    constexpr double fastest = 30.0;  // [m/s]
    const bool is_near = happens(random_, mixture_.near_share);
    danger::State now = is_near ? drawn_near_boundary(problem_, exact_, fastest, random_)
                                : drawn_state(problem_, exact_, fastest, random_);
    std::discrete_distribution<int> which(mixture_.behaviours.begin(), mixture_.behaviours.end());
    Driver driver(static_cast<Behaviour>(which(random_)), random_(),
                  [this](const Ego& ego, double /*time*/) { return evading(ego); });
    made_.situations += 1;
    made_.near += is_near ? 1 : 0;
    State seen = as_seen(problem_, now);
    bool is_over = is_settled(problem_.ego, seen);
    for (int i = 0; i < mixture_.looks && !is_over; ++i) {
      const Demand demand = driver.next(seen.ego);
      const Look look = driven_look(problem_, now, demand);
      const State next = as_seen(problem_, look.end);
      is_over = is_settled(problem_.ego, next);
      made_.add({.observation = observation(seen),
                 .demand = demand,
                 .h = look.deepest,
                 .next_observation = observation(next),
                 .next_h = intrusion_at(problem_, look.end),
                 .is_settled = is_over,
                 .is_cut_off = !is_over && i + 1 == mixture_.looks});
      states_.push_back(now);
      now = look.end;
      seen = next;
    }
    ++made_.drives;
  }

  [[nodiscard]] Transitions take() { return std::move(made_); }
  /// x of each transition.
  [[nodiscard]] const std::vector<danger::State>& states() const { return states_; }

 private:
  [[nodiscard]] Demand evading(const Ego& ego) const {
    const danger::Acceleration best = best_({ego.X_WB.p.x, ego.X_WB.p.y, ego.X_WB.yaw, ego.v_B.x});
    const double most = problem_.system.grip * vehicle::gravity;
    return manoeuvre::admissible({best.along / most, best.across / most});
  }

  const PointMass& problem_;
  Random random_;
  const danger::ValueAt& exact_;
  danger::Steering best_;
  Mixture mixture_;
  Transitions made_;
  std::vector<danger::State> states_;
};

std::vector<Demand> all_around() {
  constexpr int directions = 16;
  std::vector<Demand> all{{}};
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / directions;
    all.push_back({std::cos(angle), std::sin(angle)});
  }
  return all;
}

}  // namespace

Result<ExactPointMass> read_exact_point_mass(const std::filesystem::path& path) {
  const auto solved = danger::read_solved(path);
  if (!solved.has_value()) {
    return solved.error();
  }
  const auto text = danger::parse_avoidance_case(solved.value().problem, path.string());
  if (!text.has_value()) {
    return text.error();
  }
  const danger::AvoidanceCase& problem = text.value();
  if (!problem.obstacle || problem.system.obstacle_speed != 0.0 || !solved.value().complete) {
    return Error{Error::Code::out_of_range,
                 path.string() + ": want a whole solution of an obstacle at rest, got another"};
  }
  return ExactPointMass{
      .problem = {problem.system, problem.ego, *problem.obstacle},
      .text = solved.value().problem,
      .view = problem.view,
      .table = {solved.value().grid, snapshot(solved.value(), solved.value().times.size() - 1)}};
}

SeenByNet seen_by_net(const PointMass& problem, const danger::State& at) {
  return seen_by_net(problem.ego, observation(as_seen(problem, at)), 0, problem.obstacle.shape);
}

Transitions point_mass_transitions(const PointMass& problem, const danger::ValueAt& exact,
                                   int drives, std::uint64_t seed) {
  expects(drives >= 1, "at least one drive");
  expects(problem.system.obstacle_speed == 0.0, "an obstacle at rest");
  PointMassDrives all(problem, exact, seed);
  for (int i = 0; i < drives; ++i) {
    all.add_drive();
  }
  return all.take();
}

Outcomes point_mass_outcomes(const PointMass& problem, const danger::ValueAt& exact, int states,
                             std::uint64_t seed) {
  expects(states >= 1, "at least one state");
  constexpr std::size_t looks_apart = 3;  // neighbours on a drive tell little more than one of them
  PointMassDrives drives(problem, exact, seed);
  const std::size_t looks = looks_apart * static_cast<std::size_t>(states);
  while (drives.states().size() < looks) {
    drives.add_drive();
  }
  const std::vector<Demand> inputs = all_around();
  Outcomes all{.num_inputs = inputs.size()};
  const auto add = [](std::vector<float>& rows, std::vector<float>& h, const SeenByNet& seen) {
    rows.insert(rows.end(), seen.inputs.begin(), seen.inputs.end());
    h.push_back(static_cast<float>(told(seen.h)));
  };
  for (std::size_t i = 0; i < looks; i += looks_apart) {
    const danger::State& at = drives.states()[i];
    add(all.states, all.h_at, seen_by_net(problem, at));
    for (const Demand& input : inputs) {
      const Look look = driven_look(problem, at, input);
      add(all.next_states, all.next_h, seen_by_net(problem, look.end));
      all.h.push_back(static_cast<float>(told(look.deepest)));
      all.settled.push_back(is_settled(problem.ego, as_seen(problem, look.end)) ? 1.0F : 0.0F);
    }
  }
  return all;
}

ValueErrors value_errors(const PointMass& problem, const danger::ValueAt& exact,
                         const Values& values, double fastest, int states, std::uint64_t seed) {
  expects(states >= 1, "at least one state");
  Random random(seed);
  std::vector<danger::State> at(static_cast<std::size_t>(states));
  std::generate(at.begin(), at.end(),
                [&] { return drawn_near_boundary(problem, exact, fastest, random); });
  const std::vector<double> told = values(at);
  std::vector<double> sizes;
  ValueErrors errors{.states = at.size()};
  const double share = 1.0 / states;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double truth = exact(at[i]).value;
    const double off = told[i] - truth;
    sizes.push_back(std::abs(off));
    errors.bias += share * off;
    errors.mean_size += share * sizes.back();
    errors.same_sign += (told[i] >= 0.0) == (truth >= 0.0) ? share : 0.0;
  }
  std::sort(sizes.begin(), sizes.end());
  errors.p99_size = sizes[static_cast<std::size_t>(0.99 * (states - 1))];
  return errors;
}

}  // namespace saca::learned_danger
