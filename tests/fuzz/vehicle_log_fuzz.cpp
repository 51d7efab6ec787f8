#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/lab/tune/fit_log.h"

// Whatever a log holds: it is refused with a message, or it is whole and comes back from its own
// writing. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace tune = saca::tune;
  const saca::vehicle::Vehicle car{.mass = 1700.0,
                                   .yaw_inertia = 2700.0,
                                   .cg_to_front_axle = 1.35,
                                   .cg_to_rear_axle = 1.45,
                                   .track_width = 1.6,
                                   .cg_height = 0.5,
                                   .wheel_radius = 0.32};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = tune::read_log(text, "fuzz.csv", car);
  if (!read.has_value()) {
    if (read.error().message.rfind("fuzz.csv:", 0) != 0) {
      __builtin_trap();
    }
    return 0;
  }
  const tune::Log& log = read.value();
  const bool whole = !log.measured.empty() && log.measured.front().signal == tune::Signal::speed &&
                     log.event > 0 && log.event < log.time.size() &&
                     log.command.size() == log.time.size();
  if (!whole) {
    __builtin_trap();
  }
  for (const tune::Series& series : log.measured) {
    if (series.values.size() != log.time.size()) {
      __builtin_trap();
    }
    for (const double value : series.values) {
      if (!std::isfinite(value)) {
        __builtin_trap();
      }
    }
  }
  if (tune::write_log(log).empty()) {
    __builtin_trap();
  }
  return 0;
}
