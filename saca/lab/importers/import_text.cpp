#include "saca/lab/importers/import_text.h"

#include <fmt/core.h>

#include <cstddef>

namespace saca::importers {

std::string import_text(const HundredCarReport& report, const HundredCarRequest& request,
                        const std::string& output) {
  return fmt::format(
      "{}: event {}, rows {} to {}; lead seen in {} rows, {} gaps bridged, {} outliers\n", output,
      request.event, report.first_row, report.last_row, report.lead.num_seen, report.lead.num_gaps,
      report.lead.num_outliers);
}

std::string import_text(const std::vector<HundredCarOutcome>& outcomes) {
  const std::size_t rebuilt = num_rebuilt(outcomes);
  std::string text = fmt::format("{} events: {} rebuilt, {} refused\n", outcomes.size(), rebuilt,
                                 outcomes.size() - rebuilt);
  for (const auto& [reason, count] : refusals(outcomes)) {
    text += fmt::format("  {:5} {:24} {}\n", count, name(reason), meaning(reason));
  }
  return text;
}

std::string import_text(const TrafficImport& made, const TrafficRequest& request,
                        const std::string& output) {
  const TrafficReport& report = made.report;
  const recordings::LaneFit& lane = report.lane;
  std::string text = fmt::format(
      "{}: {} vehicles around {}, {:.1f} s\n", output, made.scenario.actors.size(),
      request.ego ? fmt::format("obstacle {}", *request.ego) : "the planning problem's start",
      made.scenario.duration);
  text += fmt::format("  lane: an arc over {:.0f} m ahead, {:.2f} m off rms, {:.2f} m at most\n",
                      lane.ahead, lane.rms, lane.largest);
  text += fmt::format("  smoothing: {:.2f} m rms, {:.2f} m at most, {} outliers\n",
                      report.rms_shift, report.largest_shift, report.num_outliers);
  for (const auto& [reason, count] : report.left_out) {
    text += fmt::format("  left out: {} {}\n", count, reason);
  }
  for (const auto& [element, count] : report.ignored) {
    text += fmt::format("  ignored: {} {}\n", count, element);
  }
  return text;
}

}  // namespace saca::importers
