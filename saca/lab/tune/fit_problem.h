#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "saca/lab/tune/fit_response.h"

namespace saca::tune {

/// A parameter that a fit may change, and what is known of it beforehand.
struct Candidate {
  std::string_view section;
  std::string_view key;
  double vehicle::Vehicle::*member;  ///< nullptr for a tyre's parameter and the grip
  double vehicle::Tyre::*tyre_member;
  bool logarithmic;  ///< the sd is that of the logarithm
  double sd;
  double least;  ///< values beyond are those of no car
  double most;
};

/// The grip of the road, then the car's.
constexpr std::size_t num_candidates = 8;
[[nodiscard]] const std::array<Candidate, num_candidates>& candidates();

/// The least squares of a fit. Part of `fit_vehicle`; including it needs Eigen.
///
/// Its unknowns x have mean 0 and sd 1 beforehand: the candidates, then for each log the speed at
/// the first row and the offset of each signal.
class FitProblem {
 public:
  FitProblem(vehicle::Vehicle base, double grip, const std::vector<Log>& logs);

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] Eigen::Index num_residuals() const { return num_data_ + size_; }

  /// A candidate's value, in its own unit.
  [[nodiscard]] double value(std::size_t candidate, double x) const;
  /// The x that gives a value inside the candidate's bounds.
  [[nodiscard]] double x_of(std::size_t candidate, double value) const;
  [[nodiscard]] Hypothesis hypothesis(const Eigen::VectorXd& x, std::size_t log) const;

  /// One series that takes part: all but what the motor holds where its command is not known.
  struct Place {
    std::size_t log;
    std::size_t column;    ///< among log.measured
    std::size_t begin;     ///< first row that counts
    Eigen::Index first;    ///< residual of that row
    Eigen::Index unknown;  ///< the sensor's offset
  };
  [[nodiscard]] const std::vector<Place>& series() const { return places_; }

  /// Measured less predicted, in the unit of the column   (series, rows that count).
  [[nodiscard]] std::vector<std::vector<double>> errors(const Eigen::VectorXd& x) const;
  [[nodiscard]] double offset(const Eigen::VectorXd& x, std::size_t series) const;

  /// Sets what the errors of each series are divided by; begins with `noise`.
  void weigh(const std::vector<double>& sd);
  /// Sd of each series between neighbouring rows, in the unit of its column.
  [[nodiscard]] const std::vector<double>& noise() const { return noise_; }

  /// Errors over their sd, bent beyond 3; then x itself, for what was known beforehand.
  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& x) const;
  /// Derivatives of the residuals by the unknowns in `free`   (num_residuals x free).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x,
                                         const std::vector<Eigen::Index>& free) const;

  /// Least squares over the unknowns in `free`, the others held.
  /// @param tolerance  share of the sum of squares that is not worth another step, > 0
  [[nodiscard]] Eigen::VectorXd minimum(const Eigen::VectorXd& start,
                                        const std::vector<Eigen::Index>& free,
                                        double tolerance) const;
  /// Whether any of the logs says something about a candidate, however little.
  [[nodiscard]] bool is_asked(std::size_t candidate) const;
  /// Covariance of all unknowns at x.
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::VectorXd& x) const;

 private:
  [[nodiscard]] std::vector<double> predicted(const Eigen::VectorXd& x, std::size_t log) const;
  [[nodiscard]] std::vector<double> errors(const Eigen::VectorXd& x, std::size_t series,
                                           const std::vector<double>& predicted) const;
  void add_residuals(const Eigen::VectorXd& x, std::size_t log,
                     const std::vector<double>& predicted, Eigen::VectorXd& residuals) const;

  vehicle::Vehicle base_;
  double grip_;
  const std::vector<Log>& logs_;
  std::vector<std::vector<double>> held_;  // (logs, rows)
  std::vector<double> first_speed_;        // (logs)
  std::vector<Eigen::Index> speed_index_;  // (logs)
  std::vector<Place> places_;              // (series)
  std::vector<double> noise_;              // (series)
  std::vector<double> sd_;                 // (series)
  Eigen::Index num_data_ = 0;
  Eigen::Index size_ = 0;
};

}  // namespace saca::tune
