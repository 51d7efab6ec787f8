#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "saca/core/short_number.h"

namespace saca::config {

/// How many digits a number's text has, without zeros before the first that is none.
[[nodiscard]] inline int significant_digits(std::string_view text) {
  const std::string_view mantissa = text.substr(0, text.find('e'));
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto first =
      std::find_if(mantissa.begin(), mantissa.end(), [](char c) { return c >= '1' && c <= '9'; });
  return static_cast<int>(std::count_if(first, mantissa.end(), is_digit));
}

/// JSON for people and their programs: every number that is no integer as `short_number` has it.
/// Not for what must come back to the last bit. The library's text of a number is now and then not
/// the shortest (Grisu2: of a thousand numbers of twelve digits one has 17): such a number is told
/// to one digit less.
///
/// @tparam Json  nlohmann::json, or ordered_json
template <class Json>
[[nodiscard]] Json with_short_numbers(Json document) {
  if (document.is_number_float()) {
    const auto value = document.template get<double>();
    Json number = short_number(value);
    for (int digits = short_digits - 1;
         significant_digits(number.dump()) > short_digits && digits > 0; --digits) {
      number = short_number(value, digits);
    }
    return number;
  }
  if (document.is_structured()) {
    for (auto& inner : document) {
      inner = with_short_numbers(std::move(inner));
    }
  }
  return document;
}

}  // namespace saca::config
