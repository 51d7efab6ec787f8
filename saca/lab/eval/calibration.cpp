#include "saca/lab/eval/calibration.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::eval {
namespace {

constexpr double least_probability = 1e-12;
constexpr double most_temperature = 20.0;  // the least is 1 / 20

double log_of(double probability) {
  return std::log(std::max(probability, least_probability));
}

}  // namespace

RightPolicies right_policies(const Comparison& comparison) {
  expects(!comparison.tried.empty(), "T1 comes");
  const double best = collision::harm_class(comparison.best_harm);
  RightPolicies right{};
  for (const TriedPlan& tried : comparison.tried) {
    if (tried.harm && collision::harm_class(*tried.harm) <= best) {
      right[manoeuvre::index(tried.plan.policy)] = true;
    }
  }
  return right;
}

Probabilities tempered(const Probabilities& probabilities, double temperature) {
  expects(temperature > 0.0, "temperature > 0");
  const double top = *std::max_element(probabilities.begin(), probabilities.end());
  Probabilities soft{};
  double sum = 0.0;
  for (std::size_t k = 0; k < soft.size(); ++k) {
    soft[k] = std::exp((log_of(probabilities[k]) - log_of(top)) / temperature);
    sum += soft[k];
  }
  for (double& p : soft) {
    p /= sum;
  }
  return soft;
}

double log_loss(std::span<const JudgedAnswer> judged, double temperature) {
  expects(!judged.empty(), "at least one encounter");
  double sum = 0.0;
  for (const JudgedAnswer& one : judged) {
    const Probabilities soft = tempered(one.said, temperature);
    double given = 0.0;
    for (std::size_t k = 0; k < soft.size(); ++k) {
      given += one.right[k] ? soft[k] : 0.0;
    }
    sum -= log_of(given);
  }
  return sum / static_cast<double>(judged.size());
}

// With several right policies the loss may have several valleys: a scan finds the deepest.
double best_temperature(std::span<const JudgedAnswer> judged) {
  constexpr int num_steps = 60;
  const double step = 2.0 * std::log(most_temperature) / num_steps;
  const auto loss = [&](double log_temperature) {
    return log_loss(judged, std::exp(log_temperature));
  };
  double best = -std::log(most_temperature);
  double least = loss(best);
  for (int k = 1; k <= num_steps; ++k) {
    const double at = -std::log(most_temperature) + k * step;
    if (const double here = loss(at); here < least) {
      least = here;
      best = at;
    }
  }
  double low = std::max(best - step, -std::log(most_temperature));
  double high = std::min(best + step, std::log(most_temperature));
  while (high - low > 1e-3) {  // of the logarithm: 0.1 %
    const double third = (high - low) / 3.0;
    if (loss(low + third) < loss(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return std::exp(0.5 * (low + high));
}

std::optional<Calibration> calibrated(std::span<const JudgedAnswer> judged) {
  if (judged.empty()) {
    return std::nullopt;
  }
  const double temperature = best_temperature(judged);
  return Calibration{.count = static_cast<int>(judged.size()),
                     .temperature = temperature,
                     .log_loss = log_loss(judged, temperature),
                     .log_loss_now = log_loss(judged, 1.0)};
}

}  // namespace saca::eval
