#pragma once

#include <string>
#include <string_view>

namespace saca {

/// What to add to the refusal of a number that is out of range, where it would be within it in
/// another unit that people use: " (did you mean km/h? that would be 36.1 m/s)"; else empty.
///
/// @param unit  "m/s", "s", "kg", or "-": a share or a coefficient of friction; of any other, empty
[[nodiscard]] std::string other_unit_hint(double value, double low, double high,
                                          std::string_view unit);

}  // namespace saca
