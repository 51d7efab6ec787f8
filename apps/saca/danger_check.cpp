#include "apps/saca/danger_check.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {

Result<learned_danger::Network> read_danger_network(const std::string& path) {
  const auto tensors = formats::read_tensor_file(path, many_bytes);
  return tensors.has_value() ? learned_danger::Network::from(tensors.value(), path)
                             : Result<learned_danger::Network>(tensors.error());
}

Result<DangerWeights> read_danger_weights(const std::string& path) {
  auto tensors = formats::read_tensor_file(path, many_bytes);
  if (!tensors.has_value()) {
    return tensors.error();
  }
  auto network = learned_danger::Network::from(tensors.value(), path);
  if (!network.has_value()) {
    return network.error();
  }
  const auto& words = network.value().words();
  const auto car = words.find("car");
  if (car == words.end()) {
    return Error{Error::Code::malformed, path + ": want a word `car`, got none"};
  }
  auto inputs = read_inputs(car->second);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const auto vehicle = words.find("vehicle");
  const std::string own = learned_danger::vehicle_word(inputs.value().car);
  if (vehicle != words.end() && vehicle->second != own) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want weights of the car {} as its file is now ({}), got {}: its "
                             "numbers were changed, and V_h is to be learnt anew",
                             path, car->second, own, vehicle->second)};
  }
  const world::Footprint body = manoeuvre::footprint(inputs.value().car);
  std::string car_name = car->second;
  return DangerWeights{std::move(tensors).value(), std::move(network).value(), std::move(car_name),
                       std::move(inputs).value(), body};
}

}  // namespace saca::app
