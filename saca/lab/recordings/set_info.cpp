#include "saca/lab/recordings/set_info.h"

#include <fmt/core.h>

namespace saca::recordings {
namespace {

nlohmann::json counts_json(const SetCounts& counts) {
  return {{"recordings", counts.recordings},      {"groups", counts.groups},
          {"vehicles", counts.vehicles},          {"samples", counts.samples},
          {"vehicle_hours", counts.hours},        {"steps_left", counts.steps_left},
          {"steps_right", counts.steps_right},    {"samples_in_lane", counts.in_lane},
          {"samples_with_lead", counts.with_lead}};
}

std::string counts_text(const std::string& what, const SetCounts& counts) {
  return fmt::format(
      "{}: {} recordings in {} groups, {} vehicles, {} samples, {:.2f} vehicle-hours\n"
      "  lanes crossed: {} to the left, {} to the right; samples in a lane: {}, with a lead: {}\n",
      what, counts.recordings, counts.groups, counts.vehicles, counts.samples, counts.hours,
      counts.steps_left, counts.steps_right, counts.in_lane, counts.with_lead);
}

}  // namespace

nlohmann::json set_json(const RecordedSet& set) {
  nlohmann::json sites = nlohmann::json::object();
  for (const auto& [site, counts] : counts_by_site(set)) {
    sites[site] = counts_json(counts);
  }
  return {{"schema", "saca.traffic_info/1"},
          {"all", counts_json(counts_of(set))},
          {"sites", sites},
          {"skipped", set.skipped}};
}

std::string set_text(const RecordedSet& set) {
  std::string text;
  for (const auto& [site, counts] : counts_by_site(set)) {
    text += counts_text(site, counts);
  }
  text += counts_text("all", counts_of(set));
  for (const auto& [reason, count] : set.skipped) {
    text += fmt::format("  left out: {} x {}\n", count, reason);
  }
  return text;
}

}  // namespace saca::recordings
