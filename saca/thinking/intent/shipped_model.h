#pragma once

#include "saca/thinking/intent/model.h"

namespace saca::intent {

/// The model of models/intent: for tests and benchmarks only, which run in the project's folder.
inline const Model& shipped_model() {
  static const Model model = read_model("models/intent/model.safetensors").value();
  return model;
}

}  // namespace saca::intent
