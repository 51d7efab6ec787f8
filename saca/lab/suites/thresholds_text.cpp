#include "saca/lab/suites/thresholds_text.h"

#include <fmt/core.h>

namespace saca::suites {

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

}  // namespace saca::suites
