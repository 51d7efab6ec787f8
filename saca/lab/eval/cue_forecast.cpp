#include "saca/lab/eval/cue_forecast.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "saca/base/core/contract.h"

namespace saca::eval {
namespace {

using world::num_cue_kinds;

using Forecast = std::function<double(const DrawnCues&)>;

bool anything_comes(const DrawnCues& cues) {
  return std::any_of(cues.begin(), cues.end(),
                     [](const families::DrawnCue& one) { return one.comes; });
}

Forecast by_base_rate(std::span<const DrawnCues> learnt_from) {
  CueCount any;
  for (const DrawnCues& cues : learnt_from) {
    ++any.there;
    any.came += anything_comes(cues) ? 1 : 0;
  }
  return [p = any.probability()](const DrawnCues&) { return p; };
}

constexpr int num_weights = 1 + static_cast<int>(num_cue_kinds);
using Weights = Eigen::Matrix<double, num_weights, 1>;

Weights features_of(const DrawnCues& cues) {
  Weights x = Weights::Zero();
  x[0] = 1.0;
  for (const families::DrawnCue& one : cues) {
    x[1 + static_cast<int>(one.kind)] = 1.0;
  }
  return x;
}

double sigmoid(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

/// The weights of largest posterior probability, by Newton's method: the loss is strictly convex.
Forecast by_logistic_regression(std::span<const DrawnCues> learnt_from) {
  using Square = Eigen::Matrix<double, num_weights, num_weights>;
  constexpr int steps = 30;
  constexpr double weak = 1e-3;  // of the intercept's prior: its standard deviation is 32
  Weights prior = Weights::Ones();
  prior[0] = weak;
  Weights w = Weights::Zero();
  for (int k = 0; k < steps; ++k) {
    Weights gradient = prior.cwiseProduct(w);
    Square curvature = prior.asDiagonal();
    for (const DrawnCues& cues : learnt_from) {
      const Weights x = features_of(cues);
      const double p = sigmoid(w.dot(x));
      gradient += (p - (anything_comes(cues) ? 1.0 : 0.0)) * x;
      curvature += p * (1.0 - p) * x * x.transpose();
    }
    w -= curvature.ldlt().solve(gradient);
  }
  return [w](const DrawnCues& cues) { return sigmoid(w.dot(features_of(cues))); };
}

Forecast by_law(const intent::CueLaw& law) {
  return [law](const DrawnCues& cues) {
    double none = 1.0;  // cues know nothing of each other
    for (const families::DrawnCue& one : cues) {
      const auto& unseen = law.of(one.kind);
      none *= 1.0 - (unseen ? unseen->probability : 0.0);
    }
    return 1.0 - none;
  };
}

CueForecast scored(std::string_view key, std::string_view title, const Forecast& forecast,
                   std::span<const DrawnCues> judged, std::uint64_t seed) {
  std::vector<std::optional<double>> losses;
  std::vector<std::optional<double>> squares;
  for (const DrawnCues& cues : judged) {
    const double p = forecast(cues);
    const double of_what_happened = anything_comes(cues) ? p : 1.0 - p;
    losses.emplace_back(-std::log(of_what_happened));
    squares.emplace_back((1.0 - of_what_happened) * (1.0 - of_what_happened));
  }
  return {.key = key,
          .title = title,
          .log_loss = mean_over_encounters(losses, seed),
          .brier = mean_over_encounters(squares, seed)};
}

}  // namespace

CueCounts count_cues(std::span<const DrawnCues> encounters) {
  CueCounts counts{};
  for (const DrawnCues& cues : encounters) {
    for (const families::DrawnCue& one : cues) {
      CueCount& count = counts.at(static_cast<std::size_t>(one.kind));
      ++count.there;
      count.came += one.comes ? 1 : 0;
    }
  }
  return counts;
}

CueCount all_who_may_come(const CueCounts& counts, const intent::CueLaw& law) {
  CueCount all;
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    if (law.unseen.at(k) && law.unseen.at(k)->who) {
      all.there += counts.at(k).there;
      all.came += counts.at(k).came;
    }
  }
  return all;
}

intent::CueLaw counted_law(intent::CueLaw law, const CueCounts& counts) {
  const CueCount all = all_who_may_come(counts, law);
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    if (auto& unseen = law.unseen.at(k)) {
      unseen->probability = (counts.at(k).there > 0 ? counts.at(k) : all).probability();
    }
  }
  return law;
}

std::vector<CueForecast> cue_forecasts(std::span<const DrawnCues> learnt_from,
                                       std::span<const DrawnCues> judged, const intent::CueLaw& law,
                                       std::uint64_t seed) {
  expects(!judged.empty(), "encounters to be held against");
  return {scored("base_rate", "share of all encounters", by_base_rate(learnt_from), judged, seed),
          scored("table", "table by kind", by_law(counted_law(law, count_cues(learnt_from))),
                 judged, seed),
          scored("logistic", "logistic regression on the kinds",
                 by_logistic_regression(learnt_from), judged, seed),
          scored("law", "the law they are drawn by", by_law(law), judged, seed)};
}

}  // namespace saca::eval
