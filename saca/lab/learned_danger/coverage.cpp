#include "saca/lab/learned_danger/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/percentile.h"
#include "saca/lab/learned_danger/exact.h"
#include "saca/lab/learned_danger/state.h"

namespace saca::learned_danger {
namespace {

constexpr double speed_step = 10.0;  // [m/s]
constexpr double first_grip = 0.2;
constexpr double grip_step = 0.2;
constexpr std::size_t asks_each = 10;  // drives

std::size_t bin_among(double number, double first, double step, std::size_t bins) {
  const double which = std::floor((number - first) / step);
  return static_cast<std::size_t>(std::clamp(which, 0.0, static_cast<double>(bins - 1)));
}

}  // namespace

CoverageSurvey::CoverageSurvey(const danger::Avoidance& limits, const world::Footprint& body,
                               const danger::DangerModel& model, std::size_t states,
                               std::size_t others)
    : limits_(limits), body_(body), model_(model), states_(states), others_(others) {
  expects(states >= 1 && others >= num_alike, "a state that asks, and enough that answer");
}

void CoverageSurvey::add(const Transitions& part) {
  constexpr double near = 2.0;  // [m]
  for (std::size_t i = 0; i < part.size(); ++i) {
    Observation seen{};
    std::copy_n(part.observations.begin() + static_cast<std::ptrdiff_t>(i * num_features),
                num_features, seen.begin());
    if (num_obstacles_of(seen) != 1) {
      continue;
    }
    const State state = seen_state(seen);
    const Obstacle& obstacle = state.obstacles[0];
    Bin& bin = bins_[bin_among(norm(state.ego.v_B), 0.0, speed_step, speeds) * grips +
                     bin_among(state.grip, first_grip, grip_step, grips)];
    const bool asks = static_cast<std::size_t>(part.drive[i]) % asks_each == 0;
    if (asks ? bin.asks.size() >= states_ : bin.answers.size() >= others_) {
      continue;
    }
    const auto value = exact_value(model_, body_, state, obstacle);
    if (!value || std::abs(*value) > near) {
      continue;
    }
    const NetInputs inputs = seen_by_net(body_, seen, 0).inputs;
    if (asks) {
      bin.asks.push_back({inputs, *exact_best(model_, limits_, body_, state, obstacle)});
    } else {
      bin.answers.push_back({inputs,
                             {static_cast<double>(part.actions[2 * i]),
                              static_cast<double>(part.actions[2 * i + 1])}});
    }
  }
}

bool CoverageSurvey::is_full() const {
  return std::all_of(bins_.begin(), bins_.end(), [this](const Bin& bin) {
    return bin.asks.size() >= states_ && bin.answers.size() >= others_;
  });
}

double CoverageSurvey::nearest(const Row& asks, const std::vector<Row>& answers) {
  std::vector<std::pair<float, std::size_t>> apart(answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < num_net_inputs; ++k) {
      const float off = answers[i].inputs[k] - asks.inputs[k];
      sum += off * off;
    }
    apart[i] = {sum, i};
  }
  std::nth_element(apart.begin(), apart.begin() + num_alike - 1, apart.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < num_alike; ++i) {
    const manoeuvre::Demand& done = answers[apart[i].second].demand;
    least = std::min(least,
                     std::hypot(done.along - asks.demand.along, done.across - asks.demand.across));
  }
  return least;
}

std::vector<Coverage> CoverageSurvey::figures(int threads) const {
  std::vector<Coverage> all;
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    const Bin& bin = bins_[k];
    if (bin.asks.empty() || bin.answers.size() < num_alike) {
      continue;
    }
    std::vector<double> apart(bin.asks.size());
    in_parallel(apart.size(), threads,
                [&](std::size_t i) { apart[i] = nearest(bin.asks[i], bin.answers); });
    const std::size_t of_speed = k / grips;
    const std::size_t of_grip = k % grips;
    const auto speed = static_cast<double>(of_speed);
    const auto grip = static_cast<double>(of_grip);
    all.push_back({.slowest = speed_step * speed,
                   .fastest = speed_step * (speed + 1.0),
                   .least_grip = first_grip + grip_step * grip,
                   .most_grip = first_grip + grip_step * (grip + 1.0),
                   .states = bin.asks.size(),
                   .others = bin.answers.size(),
                   .median = percentile(apart, 0.5),
                   .p90 = percentile(apart, 0.9)});
  }
  return all;
}

}  // namespace saca::learned_danger
