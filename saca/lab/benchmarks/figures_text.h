#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace saca::benchmarks {

/// Figures for people: a line for each, its name and value.
/// @param figures  an object of numbers
[[nodiscard]] std::string text_of(const nlohmann::json& figures);

}  // namespace saca::benchmarks
