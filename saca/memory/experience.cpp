#include "saca/memory/experience.h"

#include <algorithm>
#include <cmath>

namespace saca::memory {

Experience::Experience(std::span<const Case> cases) {
  for (const Case& one : cases) {
    if (!one.told || !one.happened || one.trust == Trust::quarantined) {
      continue;
    }
    Errors errors;
    for (std::size_t p = 0; p < errors.size(); ++p) {
      const auto& told = (*one.told)[p];
      const auto& happened = (*one.happened)[p];
      if (told && happened) {
        errors[p] = std::clamp(*happened - *told, -most_counted, most_counted);
      }
    }
    errors_.push_back(errors);
    index_.add(static_cast<CaseId>(errors_.size()), one.scene);
  }
}

Corrections Experience::corrections(const world::Scene& scene) const noexcept {
  std::array<FeatureIndex::Hit, most_cases> hits;
  const std::size_t found = index_.nearest(features(scene), hits);
  Corrections sum{};
  Corrections weights;
  weights.fill(prior_cases);
  for (std::size_t i = 0; i < found; ++i) {
    const double apart = hits[i].difference / reach;
    const double weight = std::exp(-0.5 * apart * apart);
    const Errors& errors = errors_[static_cast<std::size_t>(hits[i].id - 1)];
    for (std::size_t p = 0; p < errors.size(); ++p) {
      if (errors[p]) {
        sum[p] += weight * *errors[p];
        weights[p] += weight;
      }
    }
  }
  for (std::size_t p = 0; p < sum.size(); ++p) {
    sum[p] /= weights[p];
  }
  return sum;
}

}  // namespace saca::memory
