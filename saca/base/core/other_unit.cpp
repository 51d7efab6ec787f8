#include "saca/base/core/other_unit.h"

#include <array>
#include <cstdio>

namespace saca {
namespace {

struct OtherUnit {
  std::string_view unit;
  std::string_view other;
  double one_other;  ///< in `unit`
};

constexpr std::array others{OtherUnit{"m/s", "km/h", 1.0 / 3.6}, OtherUnit{"s", "ms", 0.001},
                            OtherUnit{"kg", "t", 1000.0}, OtherUnit{"-", "%", 0.01}};

}  // namespace

std::string other_unit_hint(double value, double low, double high, std::string_view unit) {
  for (const OtherUnit& one : others) {
    const double meant = value * one.one_other;
    if (one.unit == unit && meant >= low && meant <= high) {
      std::array<char, 64> number{};
      (void)std::snprintf(number.data(), number.size(), meant < 1000.0 ? "%.3g" : "%.0f", meant);
      const std::string shown = unit == "-" ? "" : " " + std::string(unit);
      return " (did you mean " + std::string(one.other) + "? that would be " + number.data() +
             shown + ")";
    }
  }
  return "";
}

}  // namespace saca
