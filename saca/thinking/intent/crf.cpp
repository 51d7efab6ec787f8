#include "saca/thinking/intent/crf.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::intent {
namespace {

bool is_in(std::span<const ClassSet> allowed, std::size_t t, std::size_t k) {
  return allowed.empty() || (allowed[t] & only(k)) != 0;
}

/// log of the sum over all allowed paths that end in each class, instant by instant.
std::vector<Scores> forward(const Crf& crf, std::span<const Scores> emissions,
                            std::span<const ClassSet> allowed) {
  expects(!emissions.empty(), "at least one emission");
  expects(allowed.empty() || allowed.size() == emissions.size(), "one set per emission");
  std::vector<Scores> alpha(emissions.size());
  for (std::size_t t = 0; t < emissions.size(); ++t) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      double into = crf.start[k];
      if (t > 0) {
        Scores ways;
        for (std::size_t j = 0; j < num_classes; ++j) {
          ways[j] = alpha[t - 1][j] + crf.transition[j][k];
        }
        into = log_sum_exp(ways);
      }
      alpha[t][k] = is_in(allowed, t, k) ? into + emissions[t][k] : forbidden;
    }
  }
  return alpha;
}

/// Likewise over all allowed ways on from each class, without its own emission.
std::vector<Scores> backward(const Crf& crf, std::span<const Scores> emissions,
                             std::span<const ClassSet> allowed) {
  std::vector<Scores> beta(emissions.size(), Scores{});
  for (std::size_t t = emissions.size() - 1; t-- > 0;) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      Scores ways;
      for (std::size_t j = 0; j < num_classes; ++j) {
        ways[j] = is_in(allowed, t + 1, j)
                      ? crf.transition[k][j] + emissions[t + 1][j] + beta[t + 1][j]
                      : forbidden;
      }
      beta[t][k] = log_sum_exp(ways);
    }
  }
  return beta;
}

/// Adds `sign` times the expected number of uses of everything to `sum`; returns log Z.
double add_expectations(const Crf& crf, std::span<const Scores> emissions,
                        std::span<const ClassSet> allowed, double sign, Likelihood& sum) {
  const std::vector<Scores> alpha = forward(crf, emissions, allowed);
  const std::vector<Scores> beta = backward(crf, emissions, allowed);
  const double log_z = log_sum_exp(alpha.back());
  expects(std::isfinite(log_z), "a path is allowed");
  for (std::size_t t = 0; t < emissions.size(); ++t) {
    for (std::size_t k = 0; k < num_classes; ++k) {
      const double p = sign * std::exp(alpha[t][k] + beta[t][k] - log_z);
      sum.emissions[t][k] += p;
      if (t == 0) {
        sum.crf.start[k] += p;
        continue;
      }
      if (!is_in(allowed, t, k)) {
        continue;
      }
      for (std::size_t j = 0; j < num_classes; ++j) {
        sum.crf.transition[j][k] += sign * std::exp(alpha[t - 1][j] + crf.transition[j][k] +
                                                    emissions[t][k] + beta[t][k] - log_z);
      }
    }
  }
  return log_z;
}

}  // namespace

double log_sum_exp(std::span<const double> x) {
  double largest = forbidden;
  for (const double each : x) {
    largest = std::max(largest, each);
  }
  if (largest == forbidden) {
    return forbidden;
  }
  double sum = 0.0;
  for (const double each : x) {
    sum += std::exp(each - largest);
  }
  return largest + std::log(sum);
}

double log_partition(const Crf& crf, std::span<const Scores> emissions,
                     std::span<const ClassSet> allowed) {
  return log_sum_exp(forward(crf, emissions, allowed).back());
}

std::vector<Scores> marginals(const Crf& crf, std::span<const Scores> emissions,
                              std::span<const ClassSet> allowed) {
  Likelihood sum{.value = 0.0, .emissions = std::vector<Scores>(emissions.size()), .crf = {}};
  add_expectations(crf, emissions, allowed, 1.0, sum);
  return std::move(sum.emissions);
}

std::vector<std::uint8_t> viterbi(const Crf& crf, std::span<const Scores> emissions) {
  expects(!emissions.empty(), "at least one emission");
  std::vector<std::array<std::uint8_t, num_classes>> from(emissions.size());
  Scores best{};
  for (std::size_t t = 0; t < emissions.size(); ++t) {
    Scores next{};
    for (std::size_t k = 0; k < num_classes; ++k) {
      double into = crf.start[k];
      if (t > 0) {
        std::size_t chosen = 0;
        for (std::size_t j = 1; j < num_classes; ++j) {
          if (best[j] + crf.transition[j][k] > best[chosen] + crf.transition[chosen][k]) {
            chosen = j;
          }
        }
        from[t][k] = static_cast<std::uint8_t>(chosen);
        into = best[chosen] + crf.transition[chosen][k];
      }
      next[k] = into + emissions[t][k];
    }
    best = next;
  }
  const auto last = std::max_element(best.begin(), best.end());
  expects(*last > forbidden, "a path is allowed");
  std::vector<std::uint8_t> path(emissions.size());
  path.back() = static_cast<std::uint8_t>(last - best.begin());
  for (std::size_t t = path.size() - 1; t > 0; --t) {
    path[t - 1] = from[t][path[t]];
  }
  return path;
}

Likelihood likelihood(const Crf& crf, std::span<const Scores> emissions,
                      std::span<const ClassSet> allowed) {
  Likelihood result{.value = 0.0, .emissions = std::vector<Scores>(emissions.size()), .crf = {}};
  result.value += add_expectations(crf, emissions, allowed, 1.0, result);
  result.value -= add_expectations(crf, emissions, {}, -1.0, result);
  return result;
}

const Scores& CrfFilter::step(const Crf& crf, const Scores& emission) {
  Scores log_now;
  for (std::size_t k = 0; k < num_classes; ++k) {
    double into = crf.start[k];
    if (started_) {
      double sum = 0.0;
      for (std::size_t j = 0; j < num_classes; ++j) {
        sum += now_[j] * std::exp(crf.transition[j][k]);
      }
      into = std::log(sum);
    }
    log_now[k] = into + emission[k];
  }
  const double log_z = log_sum_exp(log_now);
  expects(std::isfinite(log_z), "a path is allowed");
  for (std::size_t k = 0; k < num_classes; ++k) {
    now_[k] = std::exp(log_now[k] - log_z);
  }
  started_ = true;
  return now_;
}

}  // namespace saca::intent
