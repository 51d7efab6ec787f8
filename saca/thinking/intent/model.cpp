#include "saca/thinking/intent/model.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"

namespace saca::intent {
namespace {

Error not_a_model(std::string_view source, const std::string& what) {
  return {Error::Code::malformed, fmt::format("{}: {}", source, what)};
}

constexpr double largest_link = 20.0;  // of a start or transition that is not forbidden

double limited(float score) {
  return std::clamp(static_cast<double>(score), -largest_link, largest_link);
}

/// The chain of one horizon, masked.
Crf chain(const std::vector<float>& start, const std::vector<float>& transition,
          std::size_t horizon) {
  Crf crf;
  for (std::size_t j = 0; j < num_classes; ++j) {
    crf.start[j] = limited(start[horizon * num_classes + j]);
    for (std::size_t k = 0; k < num_classes; ++k) {
      crf.transition[j][k] =
          may_follow(j, k) ? limited(transition[(horizon * num_classes + j) * num_classes + k])
                           : forbidden;
    }
  }
  return crf;
}

/// The calibrations, each checked.
Result<std::array<Calibration, num_horizons>> calibrations_from(const formats::Tensors& tensors,
                                                                std::string_view source) {
  const auto inverse_temperature = formats::take(tensors, "sharpness", {num_horizons}, source);
  const auto bias = formats::take(tensors, "bias", {num_horizons, num_classes}, source);
  const auto naming = formats::take(tensors, "naming", {num_horizons, num_classes}, source);
  for (const auto* each : {&inverse_temperature, &bias, &naming}) {
    if (!each->has_value()) {
      return each->error();
    }
  }
  const auto positive = [](double x) { return x > 0.0; };
  std::array<Calibration, num_horizons> calibrations;
  for (std::size_t h = 0; h < num_horizons; ++h) {
    Calibration& one = calibrations[h];
    one.inverse_temperature = static_cast<double>(inverse_temperature.value()[h]);
    if (!positive(one.inverse_temperature)) {
      return not_a_model(
          source, fmt::format("tensor sharpness: want > 0, got {}", one.inverse_temperature));
    }
    for (std::size_t k = 0; k < num_classes; ++k) {
      one.bias[k] = limited(bias.value()[h * num_classes + k]);
      one.naming[k] = static_cast<double>(naming.value()[h * num_classes + k]);
      if (!positive(one.naming[k])) {
        return not_a_model(source, fmt::format("tensor naming: want > 0, got {}", one.naming[k]));
      }
    }
  }
  return calibrations;
}

}  // namespace

Scores calibrated(const Calibration& calibration, const Scores& probabilities) {
  Scores honest;
  double sum = 0.0;
  for (std::size_t k = 0; k < num_classes; ++k) {
    honest[k] =
        std::pow(probabilities[k], calibration.inverse_temperature) * std::exp(calibration.bias[k]);
    sum += honest[k];
  }
  for (double& each : honest) {
    each /= sum;
  }
  return honest;
}

std::size_t named_class(const Scores& naming, const Scores& probabilities) {
  std::size_t named = 0;
  for (std::size_t k = 1; k < num_classes; ++k) {
    if (naming[k] * probabilities[k] > naming[named] * probabilities[named]) {
      named = k;
    }
  }
  return named;
}

Result<Model> model_from(const formats::Tensors& tensors, std::string_view source) {
  const auto num = formats::take(tensors, "networks", {1}, source);
  if (!num.has_value()) {
    return num.error();
  }
  const float wanted = num.value()[0];
  if (!(wanted >= 1.0F && wanted <= static_cast<float>(Model::max_networks))) {
    return not_a_model(
        source, fmt::format("tensor networks: want 1 to {}, got {}", Model::max_networks, wanted));
  }
  Model model;
  for (int i = 0; i < static_cast<int>(wanted); ++i) {
    auto network = Network::from(tensors, std::to_string(i) + ".", source);
    if (!network.has_value()) {
      return network.error();
    }
    model.networks.push_back(std::move(network).value());
  }
  const auto start = formats::take(tensors, "chain.start", {num_horizons, num_classes}, source);
  const auto transition =
      formats::take(tensors, "chain.transition", {num_horizons, num_classes, num_classes}, source);
  for (const auto* each : {&start, &transition}) {
    if (!each->has_value()) {
      return each->error();
    }
  }
  for (std::size_t h = 0; h < num_horizons; ++h) {
    model.chains[h] = chain(start.value(), transition.value(), h);
  }
  const auto calibrations = calibrations_from(tensors, source);
  if (!calibrations.has_value()) {
    return calibrations.error();
  }
  model.calibrations = calibrations.value();
  return model;
}

std::uint64_t digest(const Model& model) {
  Fnv hash;
  for (const Network& network : model.networks) {
    network.add_to(hash);
  }
  hash.add_doubles(model.chains);
  hash.add_doubles(model.calibrations);
  return hash.value();
}

Result<Model> read_model(const std::filesystem::path& path) {
  const auto tensors = formats::read_tensor_file(path);
  if (!tensors.has_value()) {
    return tensors.error();
  }
  return model_from(tensors.value(), path.string());
}

HorizonScores Stream::step(const Model& model, const Observation& observation) {
  expects(!model.networks.empty() && model.networks.size() <= Model::max_networks,
          "1 to max_networks networks");
  history_.add(observation);
  const Features features = history_.features();
  Emissions mean{};
  const double share = 1.0 / static_cast<double>(model.networks.size());
  for (std::size_t i = 0; i < model.networks.size(); ++i) {
    const Emissions told = model.networks[i].step(features, states_[i]);
    for (std::size_t h = 0; h < num_horizons; ++h) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        mean[h][k] += share * told[h][k];
      }
    }
  }
  HorizonScores told;
  for (std::size_t h = 0; h < num_horizons; ++h) {
    told[h] = calibrated(model.calibrations[h], filters_[h].step(model.chains[h], mean[h]));
  }
  return told;
}

}  // namespace saca::intent
