#include "saca/lab/tune/fit_vehicle.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/core/percentile.h"
#include "saca/lab/tune/fit_problem.h"

namespace saca::tune {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double normal_95 = 1.96;    // sd on either side of a normal distribution's 95 %
constexpr double enough_known = 0.3;  // of the sd beforehand: what is narrower is determined
constexpr double far_off = 6.0;       // sd: an outlier
constexpr double most_error = 1.5;    // rms over noise: above it the model leaves something over
constexpr double longest_run = 4.0;   // rows: likewise
// Of the sum of squares, which is about the number of values: a thousandth of some thousand of them
// is a few, and one is one sd of a parameter.
constexpr double rough = 1e-3;
constexpr double fine = 1e-5;
constexpr double dead_time_step = vehicle::BrakeLine::slot;

// The grip's scale is found first: where wheels lock, the way to it is not downhill from
// everywhere.
VectorXd best_grip(const FitProblem& problem) {
  VectorXd best = VectorXd::Zero(problem.size());
  double least = problem.residuals(best).squaredNorm();
  for (const double grip : {0.15, 0.25, 0.35, 0.5, 0.7, 0.9, 1.1}) {
    VectorXd x = VectorXd::Zero(problem.size());
    x[0] = problem.x_of(0, grip);
    const double sum = problem.residuals(x).squaredNorm();
    if (sum < least) {
      least = sum;
      best = x;
    }
  }
  return best;
}

// Of the errors of one series.
struct Spread {
  double sd = 0.0;   // by the median size: outliers do not matter
  double rms = 0.0;  // outliers left out
  double run = 1.0;  // sum of the autocorrelation, both ways
  std::size_t num_outliers = 0;
};

Spread spread_of(const std::vector<double>& errors, double noise) {
  std::vector<double> sizes(errors.size());
  std::transform(errors.begin(), errors.end(), sizes.begin(),
                 [](double error) { return std::abs(error); });
  Spread spread;
  spread.sd = std::max(percentile(sizes, 0.5) / 0.6745, noise);
  std::vector<double> kept = errors;
  double sum = 0.0;
  for (double& error : kept) {
    if (std::abs(error) > far_off * spread.sd) {
      error = 0.0;
      ++spread.num_outliers;
    }
    sum += error * error;
  }
  spread.rms = std::sqrt(sum / static_cast<double>(kept.size() - spread.num_outliers));
  // Until it has died away; then it is only chance.
  constexpr double died_away = 0.05;
  for (std::size_t lag = 1; sum > 0.0 && lag < kept.size() / 4; ++lag) {
    double product = 0.0;
    for (std::size_t row = lag; row < kept.size(); ++row) {
      product += kept[row] * kept[row - lag];
    }
    if (product / sum < died_away) {
      break;
    }
    spread.run += 2.0 * product / sum;
  }
  return spread;
}

std::vector<Spread> spreads_of(const FitProblem& problem, const VectorXd& x) {
  const std::vector<std::vector<double>> errors = problem.errors(x);
  std::vector<Spread> spreads;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    spreads.push_back(spread_of(errors[k], problem.noise()[k]));
  }
  return spreads;
}

// Each series counts as many independent observations as it holds.
void weigh_by(FitProblem& problem, const std::vector<Spread>& spreads) {
  std::vector<double> sd;
  sd.reserve(spreads.size());
  for (const Spread& spread : spreads) {
    sd.push_back(spread.sd * std::sqrt(spread.run));
  }
  problem.weigh(sd);
}

// Six digits, as a car's file gets it.
double rounded(double value) {
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

bool is_dead_time(const Candidate& candidate) {
  return candidate.member == &vehicle::Vehicle::brake_dead_time;
}

std::vector<Index> determined_by(const FitProblem& problem, const MatrixXd& covariance) {
  std::vector<Index> determined;
  for (Index k = 0; k < static_cast<Index>(num_candidates); ++k) {
    if (problem.is_asked(static_cast<std::size_t>(k)) &&
        std::sqrt(covariance(k, k)) < enough_known) {
      determined.push_back(k);
    }
  }
  return determined;
}

double condition_of(const MatrixXd& covariance, const std::vector<Index>& determined) {
  if (determined.empty()) {
    return 1.0;
  }
  const auto size = static_cast<Index>(determined.size());
  MatrixXd correlation(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = 0; j < size; ++j) {
      const Index a = determined[static_cast<std::size_t>(i)];
      const Index b = determined[static_cast<std::size_t>(j)];
      correlation(i, j) = covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  }
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(correlation).eigenvalues();
  return values[size - 1] / values[0];
}

bool contains(const std::vector<Index>& indices, std::size_t index) {
  return std::find(indices.begin(), indices.end(), static_cast<Index>(index)) != indices.end();
}

// `centre` is where the estimate was while all were free. Its interval holds whatever those are
// that went back to the base; the value is what goes with the base.
std::vector<FittedParameter> parameters_of(const FitProblem& problem, const VectorXd& x,
                                           const VectorXd& centre, const MatrixXd& covariance,
                                           const std::vector<Index>& determined) {
  std::vector<FittedParameter> parameters;
  for (std::size_t k = 0; k < num_candidates; ++k) {
    const auto index = static_cast<Index>(k);
    FittedParameter one{.section = candidates().at(k).section,
                        .key = candidates().at(k).key,
                        .base = problem.value(k, 0.0)};
    one.value = one.low = one.high = one.base;
    if (contains(determined, k)) {
      const double half = normal_95 * std::sqrt(covariance(index, index));
      one.determined = true;
      one.value = rounded(problem.value(k, x[index]));
      one.low = std::min(one.value, problem.value(k, centre[index] - half));
      one.high = std::max(one.value, problem.value(k, centre[index] + half));
    }
    parameters.push_back(one);
  }
  return parameters;
}

vehicle::Vehicle car_of(const vehicle::Vehicle& base,
                        const std::vector<FittedParameter>& parameters) {
  vehicle::Vehicle car = base;
  for (std::size_t k = 0; k < num_candidates; ++k) {
    const Candidate& one = candidates().at(k);
    if (one.member != nullptr) {
      car.*one.member = parameters[k].value;
    } else if (one.tyre_member != nullptr) {
      car.tyre.*one.tyre_member = parameters[k].value;
    }
  }
  return car;
}

void warn_of_parameters(VehicleFit& fit) {
  constexpr double worst_condition = 1000.0;
  bool any = false;
  for (std::size_t k = 0; k < num_candidates; ++k) {
    const FittedParameter& one = fit.parameters[k];
    const Candidate& candidate = candidates().at(k);
    any = any || (one.determined && candidate.section != "road");
    const double away = candidate.logarithmic ? std::log(one.value / one.base) / candidate.sd
                                              : (one.value - one.base) / candidate.sd;
    constexpr double too_far = 2.5;  // sd beforehand
    const bool at_bound = one.value <= candidate.least || one.value >= candidate.most;
    if (one.determined && (std::abs(away) > too_far || (at_bound && candidate.least > 0.0))) {
      fit.warnings.push_back(fmt::format(
          "{}.{}: {:g} is implausibly far from the base's {:g}; are mass and wheel radius right?",
          one.section, one.key, one.value, one.base));
    }
  }
  if (!any) {
    fit.warnings.emplace_back("the logs determine no parameter of the car");
  }
  if (fit.condition > worst_condition) {
    fit.warnings.push_back(
        fmt::format("what is determined hangs together (condition {:.0f}): trust the intervals of "
                    "single parameters, not their combination",
                    fit.condition));
  }
}

void warn_of_signals(const FitProblem& problem, const VectorXd& x, const std::vector<Log>& logs,
                     VehicleFit& fit) {
  const std::vector<std::vector<double>> errors = problem.errors(x);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const SignalQuality& quality = fit.signals[k];
    const SignalInfo& signal = info(quality.signal);
    const std::string place = fmt::format("{}: {}", quality.log, signal.column);
    if (quality.rms > most_error * quality.noise || quality.run > longest_run) {
      fit.warnings.push_back(
          fmt::format("{}: the model leaves a systematic residual: rms {:.2g}, noise {:.2g}, alike "
                      "over about {:.0f} rows",
                      place, quality.rms, quality.noise, quality.run));
    }
    if (quality.num_outliers > 0) {
      const double limit = far_off * spread_of(errors[k], quality.noise).sd;
      const auto first = std::find_if(errors[k].begin(), errors[k].end(),
                                      [limit](double error) { return std::abs(error) > limit; });
      const FitProblem::Place& series = problem.series()[k];
      const std::size_t row = series.begin + static_cast<std::size_t>(first - errors[k].begin());
      fit.warnings.push_back(fmt::format("{}: {} of {} values are outliers, the first at {:g} s",
                                         place, quality.num_outliers, errors[k].size(),
                                         logs[series.log].time[row]));
    }
    if (signal.offset_sd > 0.0 && std::abs(quality.offset) > 2.0 * signal.offset_sd) {
      fit.warnings.push_back(
          fmt::format("{}: the sensor seems to be off by {:.2g}", place, quality.offset));
    }
  }
}

/// What is not determined goes back to the base, the dead time to a whole millisecond.
/// @return  the rest, which follows
std::vector<Index> held_back(const FitProblem& problem, const std::vector<Index>& all,
                             const std::vector<Index>& determined, VectorXd& x) {
  std::vector<Index> free;
  for (const Index k : all) {
    const auto index = static_cast<std::size_t>(k);
    const bool candidate = index < num_candidates;
    if (candidate && !contains(determined, index)) {
      x[k] = 0.0;
    } else if (candidate && is_dead_time(candidates().at(index))) {
      x[k] = problem.x_of(index,
                          dead_time_step * std::round(problem.value(index, x[k]) / dead_time_step));
    } else {
      free.push_back(k);
    }
  }
  return free;
}

std::vector<SignalQuality> qualities_of(const FitProblem& problem, const VectorXd& x,
                                        const std::vector<Log>& logs) {
  const std::vector<Spread> spreads = spreads_of(problem, x);
  std::vector<SignalQuality> qualities;
  qualities.reserve(spreads.size());
  for (std::size_t k = 0; k < spreads.size(); ++k) {
    const FitProblem::Place& place = problem.series()[k];
    const Log& log = logs[place.log];
    qualities.push_back({.log = log.name,
                         .signal = log.measured[place.column].signal,
                         .noise = problem.noise()[k],
                         .rms = spreads[k].rms,
                         .offset = problem.offset(x, k),
                         .run = spreads[k].run,
                         .num_outliers = spreads[k].num_outliers});
  }
  return qualities;
}

}  // namespace

VehicleFit fit_vehicle(const vehicle::Vehicle& base, double grip, const std::vector<Log>& logs) {
  expects(!logs.empty(), "at least one log");
  expects(grip >= 0.1 && grip <= 1.2, "grip in [0.1, 1.2]");
  FitProblem problem(base, grip, logs);
  std::vector<Index> all;
  for (Index k = 0; k < problem.size(); ++k) {
    const auto index = static_cast<std::size_t>(k);
    if (index >= num_candidates || problem.is_asked(index)) {
      all.push_back(k);
    }
  }

  VectorXd x = problem.minimum(best_grip(problem), all, rough);
  weigh_by(problem, spreads_of(problem, x));
  x = problem.minimum(x, all, fine);
  const MatrixXd covariance = problem.covariance(x);
  const std::vector<Index> determined = determined_by(problem, covariance);

  const VectorXd centre = x;
  const std::vector<Index> free = held_back(problem, all, determined, x);
  x = problem.minimum(x, free, fine);

  VehicleFit fit{.car = base};
  fit.parameters = parameters_of(problem, x, centre, covariance, determined);
  fit.car = car_of(base, fit.parameters);
  fit.condition = condition_of(covariance, determined);
  fit.signals = qualities_of(problem, x, logs);
  warn_of_parameters(fit);
  warn_of_signals(problem, x, logs, fit);
  return fit;
}

}  // namespace saca::tune
