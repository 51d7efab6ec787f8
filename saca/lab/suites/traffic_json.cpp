#include "saca/lab/suites/traffic_json.h"

namespace saca::suites {
namespace {

using eval::Rate;
using nlohmann::json;

void add_rate(json& out, const std::string& name, const Rate& rate) {
  out[name] = rate.value;
  out[name + ".lo"] = rate.low;
  out[name + ".hi"] = rate.high;
}

/// @param many  what is counted: "triggers"
void add_counts(json& out, const std::string& place, const std::string& many,
                const ShadowFigures& all, const ShadowCounts& counts) {
  out[place + many] = counts.per_hour.count;
  out[place + many + "_at_rest"] = counts.at_rest;
  out[place + "false_" + many] = counts.false_per_hour.count;
  if (all.hours > 0.0) {
    add_rate(out, place + many + "_per_hour", counts.per_hour);
    add_rate(out, place + "false_" + many + "_per_hour", counts.false_per_hour);
  }
  if (all.kilometres > 0.0) {
    add_rate(out, place + many + "_per_1000km", counts.per_1000km);
    add_rate(out, place + "false_" + many + "_per_1000km", counts.false_per_1000km);
  }
}

void add_shadow_figures(json& out, const std::string& place, const ShadowFigures& one) {
  out[place + "drives"] = one.drives;
  out[place + "left_out"] = one.left_out;
  out[place + "failed"] = one.failed;
  out[place + "exposure_h"] = one.hours;
  out[place + "exposure_km"] = one.kilometres;
  out[place + "previews"] = one.previews_per_hour.count;
  if (one.hours > 0.0) {
    add_rate(out, place + "previews_per_hour", one.previews_per_hour);
  }
  if (one.kilometres > 0.0) {
    add_rate(out, place + "previews_per_1000km", one.previews_per_1000km);
  }
  add_counts(out, place, "triggers", one, one.triggers);
  add_counts(out, place, "interventions", one, one.interventions);
  out[place + "danger"] = one.triggers.danger;
  out[place + "interventions_in_danger"] = one.interventions.danger;
  out[place + "early_interventions"] = one.early;
  for (const auto& [reason, times] : one.triggers.reasons) {
    out[place + "reason." + std::string(name(reason))] = times;
  }
}

}  // namespace

json traffic_json(const WatchedTraffic& traffic, const TrafficWatch& watch,
                  const std::string& version) {
  json out{{"meta.command", command_of(watch)},
           {"meta.seed", std::to_string(watch.seed)},
           {"meta.n", std::to_string(traffic.rows.size())},
           {"meta.car", watch.car},
           {"meta.version", version}};
  add_shadow_figures(out, "traffic.", shadow_figures(traffic.rows, ""));
  for (const std::string& source : sources_of(traffic)) {
    add_shadow_figures(out, "traffic." + source + ".", shadow_figures(traffic.rows, source));
  }
  return out;
}

}  // namespace saca::suites
