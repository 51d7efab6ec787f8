#include "saca/lab/benchmarks/figures_text.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace saca::benchmarks {

std::string text_of(const nlohmann::json& figures) {
  std::string text;
  for (const auto& [name, value] : figures.items()) {
    text += fmt::format("{:52} {:.6g}\n", name, value.get<double>());
  }
  return text;
}

}  // namespace saca::benchmarks
