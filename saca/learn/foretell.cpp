#include "saca/learn/foretell.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "saca/core/contract.h"
#include "saca/core/parallel.h"

namespace saca::learn {
namespace {

/// Sum of -ln of what the labels are given by probabilities to this power.
double loss_at(std::span<const Sequence> sequences, std::span<const Forecasts> forecasts,
               std::size_t head, double sharpness) {
  double loss = 0.0;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const Sequence& sequence = sequences[i];
    for (std::size_t t = 0; t + frames_ahead[head] < sequence.labels.size(); ++t) {
      const std::size_t later = t + frames_ahead[head];
      if (!sequence.scored[t] || !sequence.scored[later]) {
        continue;
      }
      double sum = 0.0;
      for (const double p : forecasts[i].at[head][t]) {
        sum += std::pow(p, sharpness);
      }
      const double given = forecasts[i].at[head][t][sequence.labels[later]];
      loss += std::log(sum) - sharpness * std::log(std::max(given, least_probability));
    }
  }
  return loss;
}

/// Where a function of one valley is least, by thirds.
template <class Function>
double least_in(double low, double high, Function&& function) {
  for (int i = 0; i < 30; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    if (function(a) < function(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<Forecasts> foretold(const intent::Model& model, std::span<const Sequence> sequences,
                                int threads) {
  std::vector<Forecasts> all(sequences.size());
  in_parallel(sequences.size(), threads, [&](std::size_t i) {
    intent::Stream stream;
    for (const intent::Observation& seen : sequences[i].observations) {
      const intent::Told told = stream.step(model, seen);
      for (std::size_t head = 0; head < num_heads; ++head) {
        all[i].at[head].push_back(told[head]);
      }
    }
  });
  return all;
}

std::array<double, intent::num_horizons> best_sharpness(std::span<const Sequence> sequences,
                                                        std::span<const Forecasts> forecasts) {
  expects(sequences.size() == forecasts.size(), "forecasts of each sequence");
  std::array<double, intent::num_horizons> best{};
  for (std::size_t head = 0; head < num_heads; ++head) {
    const double log_range = std::log(8.0);
    best[head] = std::exp(least_in(-log_range, log_range, [&](double log_sharpness) {
      return loss_at(sequences, forecasts, head, std::exp(log_sharpness));
    }));
  }
  return best;
}

}  // namespace saca::learn
