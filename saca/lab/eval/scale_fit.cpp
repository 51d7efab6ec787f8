#include "saca/lab/eval/scale_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/eval/transfer.h"

namespace saca::eval {
namespace {

constexpr std::size_t num_nearest = 20;

/// Of one case, as it is compared.
struct ScaledCase {
  match::ScaledEgo<float> ego;
  match::ScaledActors<float> actors;
  const memory::PolicyHarms* expected = nullptr;
  std::string_view encounter;
};

std::vector<ScaledCase> scaled_cases(std::span<const memory::Case> cases,
                                     const match::Scales& scales, int threads) {
  std::vector<ScaledCase> all(cases.size());
  in_parallel(cases.size(), threads, [&](std::size_t i) {
    const match::Features features = match::features(cases[i].scene);
    all[i] = {.ego = match::scaled<float>(features.ego, scales),
              .actors = match::scaled<float>(
                  std::span(features.actors.begin(), features.actors.size()), scales),
              .expected = cases[i].told ? &*cases[i].told : nullptr,
              .encounter = encounter_of(cases[i])};
  });
  std::erase_if(all, [](const ScaledCase& one) { return one.expected == nullptr; });
  return all;
}

struct Near {
  float difference2 = 0.0F;
  const ScaledCase* one = nullptr;
};

/// The nearest of other encounters, in no order.
std::vector<Near> nearest_of(const ScaledCase& query, const std::vector<ScaledCase>& cases) {
  const auto farther = [](const Near& a, const Near& b) { return a.difference2 < b.difference2; };
  const auto actors_of = [](const ScaledCase& one) {
    return std::span<const match::ScaledActor<float>>(one.actors.begin(), one.actors.size());
  };
  std::vector<Near> found;  // a heap, the farthest first
  found.reserve(num_nearest + 1);
  for (const ScaledCase& other : cases) {
    if (!query.encounter.empty() && other.encounter == query.encounter) {
      continue;
    }
    const float limit2 = found.size() < num_nearest ? std::numeric_limits<float>::infinity()
                                                    : found.front().difference2;
    const float difference2 =
        match::difference2(query.ego, actors_of(query), other.ego, actors_of(other), limit2);
    if (difference2 < limit2) {
      found.push_back({difference2, &other});
      std::push_heap(found.begin(), found.end(), farther);
      if (found.size() > num_nearest) {
        std::pop_heap(found.begin(), found.end(), farther);
        found.pop_back();
      }
    }
  }
  return found;
}

struct Sum {
  double error = 0.0;
  int count = 0;
};

Sum error_of(const ScaledCase& query, const std::vector<ScaledCase>& cases) {
  const std::vector<Near> near = nearest_of(query, cases);
  float least2 = std::numeric_limits<float>::infinity();
  for (const Near& one : near) {
    least2 = std::min(least2, one.difference2);
  }
  Sum sum;
  for (std::size_t p = 0; p < manoeuvre::num_policies; ++p) {
    double weights = 0.0;
    double harm = 0.0;
    for (const Near& one : near) {
      if (const auto& known = one.one->expected->at(p)) {
        // Against the nearest, which leaves the mean as it is: far weights would all be 0.
        const double weight = std::exp(-0.5 * static_cast<double>(one.difference2 - least2));
        weights += weight;
        harm += weight * *known;
      }
    }
    if (const auto& wanted = query.expected->at(p); wanted && weights > 0.0) {
      sum.error += std::abs(harm / weights - *wanted);
      ++sum.count;
    }
  }
  return sum;
}

}  // namespace

std::optional<double> scale_error(std::span<const memory::Case> cases,
                                  std::span<const memory::Case> queries,
                                  const match::Scales& scales, int threads) {
  const std::vector<ScaledCase> bank = scaled_cases(cases, scales, threads);
  const std::vector<ScaledCase> asked = scaled_cases(queries, scales, threads);
  std::vector<Sum> sums(asked.size());
  in_parallel(asked.size(), threads, [&](std::size_t i) { sums[i] = error_of(asked[i], bank); });
  Sum whole;
  for (const Sum& one : sums) {
    whole.error += one.error;
    whole.count += one.count;
  }
  return whole.count == 0 ? std::nullopt : std::optional(whole.error / whole.count);
}

std::optional<ScaleFit> fit_scales(std::span<const memory::Case> cases,
                                   std::span<const memory::Case> queries,
                                   const match::Scales& begin, int threads,
                                   const std::function<bool(int, double)>& go_on) {
  const auto first = scale_error(cases, queries, begin, threads);
  if (!first) {
    return std::nullopt;
  }
  ScaleFit fit{.scales = begin, .error_before = *first, .error = *first};
  int num_evaluations = 1;
  for (const double step : {1.25, 13.0 / 12.0}) {
    bool better = true;
    while (better) {
      better = false;
      for (const FittedScale& one : fitted_scales) {
        for (const double factor : {step, 1.0 / step}) {
          while (true) {
            if (!go_on(num_evaluations, fit.error)) {
              return fit;
            }
            match::Scales tried = fit.scales;
            tried.*one.value *= factor;
            const double error = *scale_error(cases, queries, tried, threads);
            ++num_evaluations;
            if (error >= fit.error) {
              break;
            }
            fit.scales = tried;
            fit.error = error;
            better = true;
          }
        }
      }
    }
  }
  fit.is_done = true;
  return fit;
}

}  // namespace saca::eval
