#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/onboard/vehicle/vehicle.h"

namespace saca::danger_study {

/// Without a look at its car: weights of a point mass have none.
/// @return  an error naming file, tensor or word, wanted and got
[[nodiscard]] Result<learned_danger::Network> read_network(const std::filesystem::path& path);

/// What a file of weights says.
struct Weights {
  formats::Tensors tensors;
  learned_danger::Network network;
  std::string car_name;  ///< the word `car`: of which car they are
};

/// @return  likewise; Error::Code::malformed as well where the car is not told
[[nodiscard]] Result<Weights> read_weights(const std::filesystem::path& path);

/// Where weights name the numbers of the car that they were learnt of (learned_danger::
/// vehicle_word), these must be those of today.
/// @param path  named by the message
/// @return      Error::Code::malformed where they are not
[[nodiscard]] std::optional<Error> why_of_another_car(const Weights& weights,
                                                      const vehicle::Vehicle& car,
                                                      const std::string& path);

}  // namespace saca::danger_study
