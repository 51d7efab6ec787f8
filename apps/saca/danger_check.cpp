#include "apps/saca/danger_check.h"

#include <utility>

namespace saca::app {

Result<DangerWeights> read_danger_weights(const std::string& path) {
  auto weights = danger_study::read_weights(path);
  if (!weights.has_value()) {
    return weights.error();
  }
  auto inputs = read_inputs(weights.value().car_name);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  if (auto other = danger_study::why_of_another_car(weights.value(), inputs.value().car, path)) {
    return *std::move(other);
  }
  return DangerWeights{std::move(weights).value(), std::move(inputs).value()};
}

}  // namespace saca::app
