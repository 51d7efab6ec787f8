#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/saca/printing.h"
#include "saca/base/formats/short_numbers.h"

namespace saca::app {

/// What `--json` prints, but for what the library writes itself: numbers as a person would write
/// them, and U+FFFD for what is no UTF-8.
/// @tparam Json  nlohmann::json, or ordered_json
template <class Json>
[[nodiscard]] std::string json_text(Json document) {
  return formats::with_short_numbers(std::move(document))
      .dump(1, ' ', false, Json::error_handler_t::replace);
}

template <class Json>
void print_json(Json document) {
  app::print("{}\n", json_text(std::move(document)));
}

}  // namespace saca::app
