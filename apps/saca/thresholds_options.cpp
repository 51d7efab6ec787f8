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

std::string thresholds_arguments(const reflex::Thresholds& thresholds) {
  constexpr reflex::Thresholds shipped;
  std::string text;
  if (thresholds.trigger != shipped.trigger) {
    text += fmt::format(" --t1-s {}", thresholds.trigger);
  }
  if (thresholds.waiting_cost != shipped.waiting_cost && thresholds.waiting_cost) {
    text += fmt::format(" --waiting-cost {}", *thresholds.waiting_cost);
  }
  return text;
}

std::string thresholds_text(const reflex::Thresholds& thresholds) {
  return fmt::format("T1 {} s, T2 {} s{}", thresholds.trigger, thresholds.preview,
                     thresholds_arguments(thresholds));
}

}  // namespace saca::app
