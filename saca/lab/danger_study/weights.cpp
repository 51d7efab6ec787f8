#include "saca/lab/danger_study/weights.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/learned_danger/learned.h"

namespace saca::danger_study {

Result<learned_danger::Network> read_network(const std::filesystem::path& path) {
  const auto tensors = formats::read_tensor_file(path, many_bytes);
  return tensors.has_value() ? learned_danger::Network::from(tensors.value(), path.string())
                             : Result<learned_danger::Network>(tensors.error());
}

Result<Weights> read_weights(const std::filesystem::path& path) {
  auto tensors = formats::read_tensor_file(path, many_bytes);
  if (!tensors.has_value()) {
    return tensors.error();
  }
  auto network = learned_danger::Network::from(tensors.value(), path.string());
  if (!network.has_value()) {
    return network.error();
  }
  const auto& words = network.value().words();
  const auto car = words.find("car");
  if (car == words.end()) {
    return Error{Error::Code::malformed, path.string() + ": want a word `car`, got none"};
  }
  std::string name = car->second;
  return Weights{std::move(tensors).value(), std::move(network).value(), std::move(name)};
}

std::optional<Error> why_of_another_car(const Weights& weights, const vehicle::Vehicle& car,
                                        const std::string& path) {
  const auto& words = weights.network.words();
  const auto vehicle = words.find("vehicle");
  const std::string own = learned_danger::vehicle_word(car);
  if (vehicle == words.end() || vehicle->second == own) {
    return std::nullopt;
  }
  return Error{Error::Code::malformed,
               fmt::format("{}: want weights of the car {} as its file is now ({}), got {}: its "
                           "numbers were changed, and V_h is to be learnt anew",
                           path, weights.car_name, own, vehicle->second)};
}

}  // namespace saca::danger_study
