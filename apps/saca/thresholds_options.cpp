#include "apps/saca/thresholds_options.h"

#include <fmt/core.h>

namespace saca::app {

void add_thresholds_options(CLI::App& command, reflex::Thresholds& thresholds) {
  constexpr reflex::Thresholds shipped;
  command
      .add_option("--t1-s", thresholds.trigger,
                  "T1: everybody who acts at the trigger acts when a conflict is so near [s]")
      ->default_val(shipped.trigger)
      ->check(CLI::Range(0.1, shipped.preview));
  command
      .add_option_function<double>(
          "--waiting-cost", [&thresholds](double cost) { thresholds.waiting_cost = cost; },
          fmt::format("Of SACA: before T1, it acts as soon as waiting is expected to cost more "
                      "harm than this (default: {})",
                      *shipped.waiting_cost))
      ->check(CLI::Range(0.0, 1.0));
}

}  // namespace saca::app
