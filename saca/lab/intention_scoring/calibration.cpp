#include "saca/lab/intention_scoring/calibration.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/lead_time.h"

namespace saca::intention_scoring {
namespace {

using intent::Calibration;
using intent::num_classes;

/// Sharpness, and the biases of FB, of LC and RC, of LB and RB.
using Parameters = Eigen::Vector4d;
constexpr std::array<Eigen::Index, num_classes> bias_of{0, 2, 2, 1, 3, 3};  // 0: M has none

constexpr double least_log = -30.0;  // of a probability: more would let one frame decide

/// What is predicted of one scored frame, and its label.
struct Frame {
  ClassProbabilities log;
  std::uint8_t label = 0;
};

std::vector<Frame> scored_frames(std::span<const Sequence> sequences,
                                 std::span<const Forecasts> forecasts, std::size_t head) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    each_judged_frame(sequences[i], head, [&](std::size_t t, std::size_t later) {
      Frame frame{.log = {}, .label = sequences[i].labels[later]};
      for (std::size_t k = 0; k < num_classes; ++k) {
        frame.log[k] = std::max(std::log(forecasts[i].at[head][t][k]), least_log);
      }
      frames.push_back(frame);
    });
  }
  return frames;
}

/// What a class's score is made of: its derivatives by the parameters.
Parameters derivatives(const Frame& frame, std::size_t k) {
  Parameters x = Parameters::Zero();
  x[0] = frame.log[k];
  if (bias_of[k] > 0) {
    x[bias_of[k]] = 1.0;
  }
  return x;
}

Calibration calibration_of(const Parameters& parameters) {
  Calibration calibration{.inverse_temperature = parameters[0]};
  for (std::size_t k = 0; k < num_classes; ++k) {
    calibration.bias[k] = bias_of[k] > 0 ? parameters[bias_of[k]] : 0.0;
  }
  return calibration;
}

/// -log-likelihood of the labels, with its derivatives, and a weak prior that all stays as it is:
/// where a class does not occur its bias would have no end.
struct Loss {
  double value = 0.0;
  Parameters slope = Parameters::Zero();
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Zero();
};

Loss loss_at(const std::vector<Frame>& frames, const Parameters& parameters) {
  const Parameters unchanged(1.0, 0.0, 0.0, 0.0);
  Loss loss;
  loss.value = 0.5 * (parameters - unchanged).squaredNorm();
  loss.slope = parameters - unchanged;
  loss.curvature.setIdentity();
  for (const Frame& frame : frames) {
    std::array<Parameters, num_classes> x;
    ClassProbabilities score{};
    for (std::size_t k = 0; k < num_classes; ++k) {
      x[k] = derivatives(frame, k);
      score[k] = parameters.dot(x[k]);
    }
    const double top = *std::max_element(score.begin(), score.end());
    double sum = 0.0;
    Parameters mean = Parameters::Zero();
    Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
    for (std::size_t k = 0; k < num_classes; ++k) {
      const double weight = std::exp(score[k] - top);
      sum += weight;
      mean += weight * x[k];
      square += weight * x[k] * x[k].transpose();
    }
    mean /= sum;
    loss.value += std::log(sum) + top - score[frame.label];
    loss.slope += mean - x[frame.label];
    loss.curvature += square / sum - mean * mean.transpose();
  }
  return loss;
}

/// Newton's method; a step that does not help is halved, and the inverse temperature stays
/// positive.
Calibration likeliest_calibration(const std::vector<Frame>& frames) {
  constexpr int most_steps = 30;
  constexpr double least_sharpness = 0.05;
  constexpr double precision = 1e-6;  // of a parameter
  Parameters at(1.0, 0.0, 0.0, 0.0);
  Loss loss = loss_at(frames, at);
  for (int i = 0; i < most_steps; ++i) {
    Parameters step = -loss.curvature.ldlt().solve(loss.slope);
    Loss next = loss;
    for (; step.norm() > precision; step *= 0.5) {
      if (at[0] + step[0] >= least_sharpness) {
        next = loss_at(frames, at + step);
        if (next.value < loss.value) {
          break;
        }
      }
    }
    if (step.norm() <= precision) {
      break;
    }
    at += step;
    loss = next;
  }
  return calibration_of(at);
}

/// Factors of naming, and the macro F1 that they reach.
struct Naming {
  ClassProbabilities factors{};
  double macro_f1 = 0.0;
};

/// All of the grid, the best first; among equals that which changes least.
std::vector<Naming> namings(const std::vector<Frame>& frames, const Calibration& calibration) {
  constexpr double step = 0.2;  // of logarithms
  constexpr int lowest = -5;
  constexpr int highest = 8;
  std::vector<ClassProbabilities> honest;
  honest.reserve(frames.size());
  for (const Frame& frame : frames) {
    ClassProbabilities raw;
    std::transform(frame.log.begin(), frame.log.end(), raw.begin(),
                   [](double log) { return std::exp(log); });
    honest.push_back(intent::calibrated(calibration, raw));
  }
  std::vector<std::pair<int, Naming>> found;
  for (int side = lowest; side <= highest; ++side) {
    for (int brake = lowest; brake <= highest; ++brake) {
      const double s = std::exp(step * side);
      const double b = std::exp(step * brake);
      const ClassProbabilities factors{1.0, s, s, b, s * b, s * b};
      Confusion confusion;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        ++confusion.counts.at(frames[i].label).at(intent::named_class(factors, honest[i]));
      }
      found.emplace_back(std::abs(side) + std::abs(brake),
                         Naming{factors, confusion.macro_f1(recorded_classes).value_or(0.0)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.second.macro_f1 != b.second.macro_f1 ? a.second.macro_f1 > b.second.macro_f1
                                                  : a.first < b.first;
  });
  std::vector<Naming> sorted;
  sorted.reserve(found.size());
  for (const auto& each : found) {
    sorted.push_back(each.second);
  }
  return sorted;
}

double false_alarms_per_hour(std::span<const Sequence> sequences,
                             std::span<const Forecasts> forecasts) {
  FalseAlarms sum;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    sum += false_alarms(sequences[i], forecasts[i]);
  }
  return sum.per_hour().value_or(0.0);
}

/// Of the head for now: the best naming that raises no more false alarms than the limit.
ClassProbabilities quiet_naming(const std::vector<Naming>& best_first,
                                std::span<const Sequence> sequences,
                                std::span<const Forecasts> forecasts,
                                const Calibration& calibration, double limit) {
  Calibrations only_now;
  only_now[0] = calibration;
  std::vector<Forecasts> honest;
  for (const Forecasts& each : forecasts) {
    honest.push_back(calibrated(each, only_now));
  }
  for (const Naming& naming : best_first) {
    for (Forecasts& each : honest) {
      each.naming[0] = naming.factors;
    }
    if (false_alarms_per_hour(sequences, honest) <= limit) {
      return naming.factors;
    }
  }
  return Calibration{}.naming;
}

}  // namespace

Calibrations best_calibrations(std::span<const Sequence> sequences,
                               std::span<const Forecasts> forecasts, double false_alarm_limit) {
  expects(sequences.size() == forecasts.size(), "forecasts of each sequence");
  expects(false_alarm_limit >= 0.0, "false_alarm_limit >= 0");
  Calibrations best;
  for (std::size_t head = 0; head < num_heads; ++head) {
    const std::vector<Frame> frames = scored_frames(sequences, forecasts, head);
    expects(!frames.empty(), "a frame that is scored");
    best[head] = likeliest_calibration(frames);
    const std::vector<Naming> best_first = namings(frames, best[head]);
    best[head].naming =
        head == 0 ? quiet_naming(best_first, sequences, forecasts, best[head], false_alarm_limit)
                  : best_first.front().factors;
  }
  return best;
}

Forecasts calibrated(Forecasts forecasts, const Calibrations& calibrations) {
  for (std::size_t head = 0; head < num_heads; ++head) {
    for (ClassProbabilities& one : forecasts.at[head]) {
      one = intent::calibrated(calibrations[head], one);
    }
    forecasts.naming[head] = calibrations[head].naming;
  }
  return forecasts;
}

std::vector<Forecasts> cross_calibrated(std::span<const Sequence> sequences,
                                        std::span<const std::string> splits,
                                        std::vector<Forecasts> forecasts) {
  expects(splits.size() == sequences.size() && forecasts.size() == sequences.size(),
          "a split and forecasts of each sequence");
  const std::set<std::string> parts(splits.begin(), splits.end());
  expects(parts.size() >= 2, "two splits or more");
  std::vector<Forecasts> honest(forecasts.size());
  for (const std::string& part : parts) {
    std::vector<Sequence> others;
    std::vector<Forecasts> of_others;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      if (splits[i] != part) {
        others.push_back(sequences[i]);
        of_others.push_back(forecasts[i]);
      }
    }
    const Calibrations calibrations = best_calibrations(others, of_others);
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      if (splits[i] == part) {
        honest[i] = calibrated(forecasts[i], calibrations);
      }
    }
  }
  return honest;
}

}  // namespace saca::intention_scoring
