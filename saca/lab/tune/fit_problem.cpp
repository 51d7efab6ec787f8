#include "saca/lab/tune/fit_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unsupported/Eigen/NonLinearOptimization>

#include "saca/base/core/percentile.h"

namespace saca::tune {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using vehicle::Tyre;
using vehicle::Vehicle;

// Beforehand: assumptions about how far cars of one kind differ, wide on purpose. Bounds: those of
// plausible cars; they lie inside what a car's file may hold.
constexpr std::array<Candidate, num_candidates> all_candidates{{
    {"road", "grip", nullptr, nullptr, true, 0.5, 0.05, 1.2},
    {"tyre", "stiffness", nullptr, &Tyre::stiffness, true, 0.4, 5.0, 40.0},
    {"tyre", "shape", nullptr, &Tyre::shape, false, 0.2, 1.05, 1.9},
    {"body", "yaw_inertia_kgm2", &Vehicle::yaw_inertia, nullptr, true, 0.3, 100.0, 1e6},
    {"body", "drag_area_m2", &Vehicle::drag_area, nullptr, true, 0.3, 0.0, 20.0},
    {"steering", "lag_s", &Vehicle::steering_lag, nullptr, true, 0.7, 0.005, 1.0},
    {"brakes", "dead_time_s", &Vehicle::brake_dead_time, nullptr, false, 0.02, 0.0, 0.06},
    {"brakes", "lag_s", &Vehicle::brake_lag, nullptr, true, 0.7, 0.005, 1.0},
}};

constexpr double speed_sd = 0.5;  // [m/s] of the first row's speed about the quiet part's median

// Beyond this a residual counts linearly, not squared: white noise hardly gets there.
constexpr double bend = 3.0;

double bent(double r) {
  return std::abs(r) <= bend ? r
                             : std::copysign(std::sqrt(2.0 * bend * std::abs(r) - bend * bend), r);
}

// A noise that is no smaller than a digit of a usual logger.
double least_noise(Signal signal) {
  return 0.02 * info(signal).typical_noise;
}

// From second differences: a motion of the car is smooth over three rows, noise is not. Their
// median size is 0.6745 sd, their sd is sqrt(6) times the noise's.
double noise_of(const Series& series) {
  std::vector<double> sizes;
  for (std::size_t row = 2; row < series.values.size(); ++row) {
    sizes.push_back(
        std::abs(series.values[row] - 2.0 * series.values[row - 1] + series.values[row - 2]));
  }
  return percentile(sizes, 0.5) / (0.6745 * std::sqrt(6.0)) / info(series.signal).unit;
}

// Where the motor follows the logged speed, it is what the model is told, not what it says.
std::size_t first_row(const Log& log, Signal signal) {
  const bool along =
      signal == Signal::speed || signal == Signal::a_x || signal >= Signal::wheel_front_left;
  return along && log.kind == TestKind::steer && !log.motor_known ? log.time.size() : 0;
}

// Whether a log can depend on a parameter at all: steering that does not move has no lag, brakes
// that are not used no delay. It saves time, nothing else.
bool matters(const Candidate& candidate, const Log& log) {
  const auto any = [&log](auto used) {
    return std::any_of(log.command.begin(), log.command.end(), used);
  };
  if (candidate.member == &Vehicle::steering_lag) {
    return any([&log](const vehicle::Command& command) {
      return command.steering != log.command.front().steering;
    });
  }
  if (candidate.member == &Vehicle::brake_dead_time || candidate.member == &Vehicle::brake_lag) {
    return any([](const vehicle::Command& command) {
      return std::any_of(command.brake_torque.begin(), command.brake_torque.end(),
                         [](double torque) { return torque > 0.0; });
    });
  }
  return true;
}

std::vector<Index> all_of(Index size) {
  std::vector<Index> indices(static_cast<std::size_t>(size));
  std::iota(indices.begin(), indices.end(), Index{0});
  return indices;
}

VectorXd with(VectorXd x, const std::vector<Index>& free, const VectorXd& values) {
  for (std::size_t k = 0; k < free.size(); ++k) {
    x[free[k]] = values[static_cast<Index>(k)];
  }
  return x;
}

// The problem as Eigen's optimiser sees it: only what is free.
struct Functor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const FitProblem& problem;
  const VectorXd& start;
  const std::vector<Index>& free;

  [[nodiscard]] int inputs() const { return static_cast<int>(free.size()); }
  [[nodiscard]] int values() const { return static_cast<int>(problem.num_residuals()); }
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    residuals = problem.residuals(with(start, free, x));
    return 0;
  }
  int df(const VectorXd& x, MatrixXd& jacobian) const {
    jacobian = problem.jacobian(with(start, free, x), free);
    return 0;
  }
};

}  // namespace

const std::array<Candidate, num_candidates>& candidates() {
  return all_candidates;
}

FitProblem::FitProblem(Vehicle base, double grip, const std::vector<Log>& logs)
    : base_(base), grip_(grip), logs_(logs), size_(num_candidates) {
  for (std::size_t log = 0; log < logs.size(); ++log) {
    held_.push_back(held_speed(logs[log]));
    const std::vector<double>& speed = logs[log].measured.front().values;
    const auto event = speed.begin() + static_cast<std::ptrdiff_t>(logs[log].event);
    first_speed_.push_back(percentile({speed.begin(), event}, 0.5));
    speed_index_.push_back(size_++);
    for (std::size_t column = 0; column < logs[log].measured.size(); ++column) {
      const Series& series = logs[log].measured[column];
      const std::size_t begin = first_row(logs[log], series.signal);
      if (begin == series.values.size()) {
        continue;
      }
      places_.push_back({log, column, begin, num_data_, size_++});
      noise_.push_back(std::max(noise_of(series), least_noise(series.signal)));
      num_data_ += static_cast<Index>(series.values.size() - begin);
    }
  }
  sd_ = noise_;
}

double FitProblem::value(std::size_t candidate, double x) const {
  const Candidate& one = all_candidates.at(candidate);
  const double base = one.member != nullptr        ? base_.*one.member
                      : one.tyre_member != nullptr ? base_.tyre.*one.tyre_member
                                                   : grip_;
  if (x == 0.0) {
    return base;
  }
  return std::clamp(one.logarithmic ? base * std::exp(one.sd * x) : base + one.sd * x, one.least,
                    one.most);
}

double FitProblem::x_of(std::size_t candidate, double wanted) const {
  const Candidate& one = all_candidates.at(candidate);
  const double base = value(candidate, 0.0);
  return (one.logarithmic ? std::log(wanted / base) : wanted - base) / one.sd;
}

Hypothesis FitProblem::hypothesis(const VectorXd& x, std::size_t log) const {
  Hypothesis hypothesis{.car = base_, .grip = grip_};
  for (std::size_t k = 0; k < num_candidates; ++k) {
    const Candidate& one = all_candidates[k];
    double& place = one.member != nullptr        ? hypothesis.car.*one.member
                    : one.tyre_member != nullptr ? hypothesis.car.tyre.*one.tyre_member
                                                 : hypothesis.grip;
    place = value(k, x[static_cast<Index>(k)]);
  }
  hypothesis.speed = std::max(1.0, first_speed_[log] + speed_sd * x[speed_index_[log]]);
  return hypothesis;
}

double FitProblem::offset(const VectorXd& x, std::size_t series) const {
  const Place& place = places_[series];
  return info(logs_[place.log].measured[place.column].signal).offset_sd * x[place.unknown];
}

std::vector<double> FitProblem::predicted(const VectorXd& x, std::size_t log) const {
  return response(logs_[log], held_[log], hypothesis(x, log));
}

std::vector<double> FitProblem::errors(const VectorXd& x, std::size_t k,
                                       const std::vector<double>& model) const {
  const Place& place = places_[k];
  const std::vector<Series>& measured = logs_[place.log].measured;
  const Series& series = measured[place.column];
  const double shift = offset(x, k);
  std::vector<double> errors;
  errors.reserve(series.values.size());
  for (std::size_t row = place.begin; row < series.values.size(); ++row) {
    const double error = series.values[row] - model[row * measured.size() + place.column];
    errors.push_back(error / info(series.signal).unit - shift);
  }
  return errors;
}

std::vector<std::vector<double>> FitProblem::errors(const VectorXd& x) const {
  std::vector<std::vector<double>> all;
  std::vector<double> model;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == 0 || places_[k].log != places_[k - 1].log) {
      model = predicted(x, places_[k].log);
    }
    all.push_back(errors(x, k, model));
  }
  return all;
}

void FitProblem::weigh(const std::vector<double>& sd) {
  sd_ = sd;
}

void FitProblem::add_residuals(const VectorXd& x, std::size_t log, const std::vector<double>& model,
                               VectorXd& residuals) const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (places_[k].log != log) {
      continue;
    }
    Index row = places_[k].first;
    for (const double error : errors(x, k, model)) {
      residuals[row++] = bent(error / sd_[k]);
    }
  }
}

bool FitProblem::is_asked(std::size_t candidate) const {
  const Candidate& one = all_candidates.at(candidate);
  if (one.member != &Vehicle::drag_area) {
    return true;
  }
  // A motor that holds the speed hides the drag; one that is let go has a drag of its own.
  return base_.drag_area > 0.0 &&
         std::any_of(logs_.begin(), logs_.end(), [](const Log& log) { return log.motor_known; });
}

VectorXd FitProblem::residuals(const VectorXd& x) const {
  VectorXd residuals(num_residuals());
  for (std::size_t log = 0; log < logs_.size(); ++log) {
    add_residuals(x, log, predicted(x, log), residuals);
  }
  residuals.tail(size_) = x;
  return residuals;
}

MatrixXd FitProblem::jacobian(const VectorXd& x, const std::vector<Index>& free) const {
  // Coarser ones pull the fit of an anti-lock stop, whose wheels are near their peak, off its
  // place.
  constexpr double step = 0.001;
  std::vector<std::vector<double>> model;
  VectorXd base(num_residuals());
  for (std::size_t log = 0; log < logs_.size(); ++log) {
    model.push_back(predicted(x, log));
    add_residuals(x, log, model.back(), base);
  }
  base.tail(size_) = x;

  MatrixXd jacobian(num_residuals(), static_cast<Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Index unknown = free[k];
    VectorXd moved = x;
    moved[unknown] += step;
    VectorXd there = base;
    there[num_data_ + unknown] += step;
    for (std::size_t log = 0; log < logs_.size(); ++log) {
      const bool of_the_car =
          unknown < static_cast<Index>(num_candidates) &&
          matters(all_candidates[static_cast<std::size_t>(unknown)], logs_[log]);
      const bool of_this_log = unknown >= speed_index_[log] &&
                               (log + 1 == logs_.size() || unknown < speed_index_[log + 1]);
      if (of_the_car || unknown == speed_index_[log]) {
        add_residuals(moved, log, predicted(moved, log), there);
      } else if (of_this_log) {
        add_residuals(moved, log, model[log], there);
      }
    }
    jacobian.col(static_cast<Index>(k)) = (there - base) / step;
  }
  return jacobian;
}

VectorXd FitProblem::minimum(const VectorXd& start, const std::vector<Index>& free,
                             double tolerance) const {
  Functor functor{*this, start, free};
  Eigen::LevenbergMarquardt<Functor> search(functor);
  search.parameters.ftol = tolerance;
  search.parameters.xtol = 1e-4;  // sd beforehand
  search.parameters.maxfev = 60;
  search.parameters.factor = 1.0;  // first step within one sd beforehand
  search.useExternalScaling = true;
  VectorXd x(static_cast<Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    x[static_cast<Index>(k)] = start[free[k]];
  }
  search.diag.setOnes(x.size());
  (void)search.minimize(x);  // it may stop at maxfev: then what it left shows in the residuals
  return with(start, free, x);
}

MatrixXd FitProblem::covariance(const VectorXd& x) const {
  const MatrixXd slopes = jacobian(x, all_of(size_));
  const MatrixXd normal = slopes.transpose() * slopes;  // regular: it holds the identity
  return normal.llt().solve(MatrixXd::Identity(size_, size_));
}

}  // namespace saca::tune
