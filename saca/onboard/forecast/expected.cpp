#include "saca/onboard/forecast/expected.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "saca/base/core/contract.h"

namespace saca::forecast {

double student_t(int freedom) {
  expects(freedom >= 1, "freedom >= 1");
  if (freedom == 1) {
    return 12.706204736;  // tan(0.95 pi / 2)
  }
  if (freedom == 2) {
    return 4.302652730;  // 0.95 sqrt(2 / (1 - 0.95^2))
  }
  constexpr double z = 1.959963985;  // of the normal distribution
  constexpr double z2 = z * z;
  const double n = freedom;
  const double g1 = z * (z2 + 1.0) / 4.0;
  const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 =
      z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

Mean mean(std::span<const double> values) {
  expects(values.size() >= 2, "two values at least");
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) {
    expects(std::isfinite(value), "values are finite");
    sum += value;
  }
  const double middle = sum / n;
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - middle) * (value - middle);
  }
  const double half =
      student_t(static_cast<int>(values.size()) - 1) * std::sqrt(squares / (n - 1.0) / n);
  return {middle, middle - half, middle + half};
}

MeanOutcome expected(std::span<const collision::Outcome> outcomes) {
  std::vector<double> harm;
  std::vector<double> loss;
  int contacts = 0;
  for (const collision::Outcome& outcome : outcomes) {
    harm.push_back(outcome.harm);
    loss.push_back(outcome.collision_loss);
    contacts += outcome.contact ? 1 : 0;
  }
  return {mean(harm), mean(loss), proportion(contacts, static_cast<int>(outcomes.size()))};
}

Mean harm_difference(std::span<const collision::Outcome> a, std::span<const collision::Outcome> b) {
  expects(a.size() == b.size(), "as many draws of a as of b");
  std::vector<double> differences(a.size());
  std::transform(a.begin(), a.end(), b.begin(), differences.begin(),
                 [](const collision::Outcome& one, const collision::Outcome& other) {
                   return one.harm - other.harm;
                 });
  return mean(differences);
}

}  // namespace saca::forecast
