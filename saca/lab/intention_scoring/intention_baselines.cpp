#include "saca/lab/intention_scoring/intention_baselines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/thinking/intent/intention.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring {
namespace {

using intent::Intention;
using intent::Observation;

static_assert(intent::num_classes == num_vehicle_classes);

std::size_t class_of(bool braking, int side) {
  const Intention intention = side > 0 ? (braking ? Intention::brake_left : Intention::lane_left)
                              : side < 0
                                  ? (braking ? Intention::brake_right : Intention::lane_right)
                              : braking ? Intention::brake
                                        : Intention::maintain;
  return static_cast<std::size_t>(intention);
}

ClassProbabilities given(std::size_t named, double sure) {
  ClassProbabilities all;
  all.fill((1.0 - sure) / static_cast<double>(num_vehicle_classes - 1));
  all.at(named) = sure;
  return all;
}

/// Of the last numbers that are known; NaN: none is.
double last_mean(std::span<const Observation> history, double Observation::*value,
                 std::size_t most) {
  const std::size_t begin = history.size() - std::min(most, history.size());
  double sum = 0.0;
  double known = 0.0;
  for (const Observation& one : history.subspan(begin)) {
    if (std::isfinite(one.*value)) {
      sum += one.*value;
      known += 1.0;
    }
  }
  return sum / known;
}

/// What the rule takes to be going on.
struct Going {
  bool braking = false;
  int side = 0;

  void look(double acceleration, double lateral_speed, const LabelRule& rule) {
    if (acceleration <= rule.braking) {
      braking = true;
    } else if (!(acceleration < rule.braking_end)) {
      braking = false;
    }
    if (!(side * lateral_speed > rule.aside_end)) {
      side = 0;
    }
    if (std::abs(lateral_speed) > rule.aside_begin) {
      side = lateral_speed > 0.0 ? 1 : -1;
    }
  }
};

double log_logistic(double x) {
  return x > 0.0 ? -std::log1p(std::exp(-x)) : x - std::log1p(std::exp(x));
}

intent::Crf chain_of(const HandMadeChain& chain) {
  expects(chain.stays > 0.0 && chain.stays < 1.0, "stays in (0, 1)");
  expects(chain.maintains > 0.0 && chain.maintains < 1.0, "maintains in (0, 1)");
  intent::Crf crf;
  const double others = static_cast<double>(num_vehicle_classes - 1);
  for (std::size_t from = 0; from < num_vehicle_classes; ++from) {
    crf.start.at(from) = std::log(from == 0 ? chain.maintains : (1.0 - chain.maintains) / others);
    double allowed = 0.0;
    for (std::size_t to = 0; to < num_vehicle_classes; ++to) {
      allowed += to != from && intent::may_follow(from, to) ? 1.0 : 0.0;
    }
    for (std::size_t to = 0; to < num_vehicle_classes; ++to) {
      crf.transition.at(from).at(to) = to == from ? std::log(chain.stays)
                                       : intent::may_follow(from, to)
                                           ? std::log((1.0 - chain.stays) / allowed)
                                           : intent::forbidden;
    }
  }
  return crf;
}

/// One frame farther along the chain, with nothing seen.
ClassProbabilities carried_on(const intent::Crf& crf, const ClassProbabilities& now) {
  ClassProbabilities next{};
  for (std::size_t from = 0; from < num_vehicle_classes; ++from) {
    for (std::size_t to = 0; to < num_vehicle_classes; ++to) {
      next.at(to) += now.at(from) * std::exp(crf.transition.at(from).at(to));
    }
  }
  return next;
}

}  // namespace

Forecasts constant_motion(const Sequence& sequence) {
  const std::vector<ClassProbabilities> all(sequence.observations.size(), given(0, 1.0));
  return {{all, all, all}};
}

Forecasts causal_rule(const Sequence& sequence, const CausalRule& rule) {
  expects(rule.smoothed >= 1, "smoothed >= 1");
  expects(rule.sure > 1.0 / static_cast<double>(num_vehicle_classes) && rule.sure <= 1.0,
          "sure in (1/6, 1]");
  const std::span<const Observation> seen = sequence.observations;
  Going going;
  std::vector<ClassProbabilities> all;
  all.reserve(seen.size());
  for (std::size_t t = 0; t < seen.size(); ++t) {
    const std::span<const Observation> history = seen.first(t + 1);
    going.look(last_mean(history, &Observation::acceleration, rule.smoothed),
               last_mean(history, &Observation::lateral_speed, rule.smoothed), rule.thresholds);
    all.push_back(given(class_of(going.braking, going.side), rule.sure));
  }
  return {{all, all, all}};
}

intent::Scores emissions_by_hand(std::span<const Observation> history) {
  expects(!history.empty(), "at least one observation");
  constexpr std::size_t smoothed = 3;
  // How steep the logits are: 95 % at 0.5 m/s^2 or 0.1 m/s beyond the threshold. Assumptions.
  constexpr double per_pull = 3.0 / 0.5;   // [s^2/m]
  constexpr double per_speed = 3.0 / 0.1;  // [s/m]
  constexpr LabelRule rule{};
  const double pull = last_mean(history, &Observation::acceleration, smoothed);
  const double aside = last_mean(history, &Observation::lateral_speed, smoothed);
  const double brakes = std::isnan(pull) ? 0.0 : per_pull * (rule.braking - pull);
  const double speed = std::isnan(aside) ? 0.0 : aside;
  const double left = per_speed * (speed - rule.aside_begin);
  const double right = per_speed * (-speed - rule.aside_begin);
  // Left, right and neither exclude each other.
  const std::array<double, 3> sides{0.0, left, right};
  const double norm = intent::log_sum_exp(sides);
  intent::Scores scores{};
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    const bool braking = c >= static_cast<std::size_t>(Intention::brake);
    const std::size_t side = c % 3;  // M, LC, RC; FB, LB, RB
    scores.at(c) = log_logistic(braking ? brakes : -brakes) + sides.at(side) - norm;
  }
  return scores;
}

Forecasts crf_by_hand(const Sequence& sequence, const HandMadeChain& chain) {
  const intent::Crf crf = chain_of(chain);
  const std::span<const Observation> seen = sequence.observations;
  intent::CrfFilter filter;
  Forecasts forecasts;
  for (std::size_t t = 0; t < seen.size(); ++t) {
    ClassProbabilities told = filter.step(crf, emissions_by_hand(seen.first(t + 1)));
    std::size_t ahead = 0;
    for (std::size_t head = 0; head < num_heads; ++head) {
      for (; ahead < frames_ahead.at(head); ++ahead) {
        told = carried_on(crf, told);
      }
      forecasts.at.at(head).push_back(told);
    }
  }
  return forecasts;
}

}  // namespace saca::intention_scoring
