#pragma once

#include <filesystem>

#include "saca/intent/model.h"

namespace saca::intent {

/// The model of this source tree's models/intent: for tests and benchmarks only.
inline const Model& shipped_model() {
  static const Model model = [] {
    const auto tree = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
    return read_model(tree / "models" / "intent" / "model.safetensors").value();
  }();
  return model;
}

}  // namespace saca::intent
