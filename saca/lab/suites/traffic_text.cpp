#include "saca/lab/suites/traffic_text.h"

#include <fmt/core.h>

namespace saca::suites {
namespace {

std::string source_line(const std::string& source, const ShadowFigures& one) {
  return fmt::format("{:12} {:6} {:8.3f} {:9.2f} {:8} {:8} {:6} {:24} {:8} {:6} {:24}\n", source,
                     one.drives, one.hours, one.kilometres, one.previews_per_hour.count,
                     one.triggers.per_hour.count, one.triggers.false_per_hour.count,
                     with_bounds(one.triggers.false_per_hour), one.interventions.per_hour.count,
                     one.interventions.false_per_hour.count,
                     with_bounds(one.interventions.false_per_hour));
}

std::string reasons_text(const char* what, const ShadowCounts& counts) {
  std::string text = fmt::format("\n{}:\n", what);
  for (const auto& [reason, times] : counts.reasons) {
    text += fmt::format("{:6} {:6} {}\n", times, is_danger(reason) ? "danger" : "false",
                        meaning(reason));
  }
  return text;
}

}  // namespace

std::string with_bounds(const eval::Rate& rate) {
  return fmt::format("{:.1f} ({:.1f} to {:.1f})", rate.value, rate.low, rate.high);
}

std::string traffic_text(const WatchedTraffic& traffic) {
  const ShadowFigures all = shadow_figures(traffic.rows, "");
  std::string text =
      fmt::format("SACA in shadow: {} of {} recorded drives; rates with exact 95 % intervals\n\n",
                  traffic.rows.size(), traffic.found);
  text += fmt::format("{:12} {:>6} {:>8} {:>9} {:>8} {:>8} {:>6} {:24} {:>8} {:>6} {:24}\n",
                      "source", "drives", "h", "km", "previews", "triggers", "false", "per h",
                      "SACA acts", "false", "per h");
  for (const std::string& source : sources_of(traffic)) {
    text += source_line(source, shadow_figures(traffic.rows, source));
  }
  text += source_line("all", all);
  text += fmt::format("\n{} of the times that SACA acts come before T1.\n", all.early);
  text += reasons_text("Triggers", all.triggers);
  text += reasons_text("SACA acts", all.interventions);
  if (all.left_out > 0) {
    text += fmt::format(
        "{:6} drives could not be watched, in {} of them SACA failed: the page tells "
        "why\n",
        all.left_out, all.failed);
  }
  return text;
}

}  // namespace saca::suites
