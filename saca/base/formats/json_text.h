#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "saca/base/core/printable.h"
#include "saca/base/core/result.h"

namespace saca::formats {

/// How much JSON from outside is read. What walks a document (to show, copy or compare it) needs
/// stack for each level, so depth is bounded before anything is made of a text.
struct JsonBounds {
  std::size_t depth = 32;                      ///< of arrays and objects; ours have 9
  std::size_t bytes = std::size_t{64} << 20U;  ///< of the text; a long record has 8 MiB
};

/// What of a text breaks the bounds, as "want ..., got ..."; nullopt: nothing. It need not be JSON.
[[nodiscard]] std::optional<std::string> beyond(const JsonBounds& bounds, std::string_view text);

/// JSON from outside: all of it is read with this.
///
/// @tparam Json  nlohmann::json, or ordered_json
/// @return       malformed, "want ..., got ..." in one short line, where the text breaks the bounds
///               or is no JSON; the caller names the source
template <class Json = nlohmann::json>
[[nodiscard]] Result<Json> parse_json(std::string_view text, const JsonBounds& bounds = {}) {
  if (auto problem = beyond(bounds, text)) {
    return Error{Error::Code::malformed, *std::move(problem)};
  }
  try {
    return Json::parse(text);
  } catch (const typename Json::exception& problem) {
    // It quotes what it could not read, byte for byte and as long as it is.
    return Error{Error::Code::malformed,
                 "want JSON, got `" + one_line(text, 40) + "`: " + one_line(problem.what())};
  }
}

}  // namespace saca::formats
