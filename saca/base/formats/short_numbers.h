#pragma once

#include <utility>

#include "saca/base/core/short_number.h"

namespace saca::formats {

/// JSON for people and their programs: every number that is no integer as `short_number` has it.
/// Not for what must come back to the last bit.
///
/// @tparam Json  nlohmann::json, or ordered_json
template <class Json>
[[nodiscard]] Json with_short_numbers(Json document) {
  if (document.is_number_float()) {
    return short_number(document.template get<double>());
  }
  if (document.is_structured()) {
    for (auto& inner : document) {
      inner = with_short_numbers(std::move(inner));
    }
  }
  return document;
}

}  // namespace saca::formats
