#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::model_access {

/// By which the answers of these weights are softened, so that a probability is how often it is so;
/// 1 where nobody has measured it. Of several names that the weights begin with the last counts.
/// @param file     data/language_model.toml
/// @param weights  name of their file
[[nodiscard]] Result<double> temperature_of(const std::filesystem::path& file,
                                            const std::string& weights);

/// What a model answers by, besides the scene.
struct AnsweringModel {
  std::filesystem::path weights;
  std::string system;  ///< part of the prompt
  double temperature = 1.0;
  bool flash_attention = false;
};

/// Tells apart what may answer otherwise: by other weights, another prompt or temperature. Of the
/// weights their size and their ends (64 KiB each) count, since to read them all takes a second.
/// @return  8 hexadecimal digits
[[nodiscard]] std::string fingerprint(const AnsweringModel& model);

}  // namespace saca::model_access
