#include "saca/lab/regulation/regulation_json.h"

#include <optional>

#include "saca/base/core/units.h"

namespace saca::regulation {
namespace {

using nlohmann::json;

void add(json& out, const std::string& place, const PassCount& sum) {
  out[place + "passed"] = sum.passed;
  out[place + "passed.n"] = sum.all;
  out[place + "passed_share"] = static_cast<double>(sum.passed) / sum.all;
}

template <class T>
json value_of(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

json json_of(const RegulationRun& run, std::size_t car, std::size_t cell, std::size_t method) {
  const RegulationResult& result = run.at(car, cell, method);
  const eval::RegulationCell& of = run.cells[cell];
  const eval::RegulationRow& row = run.row_of(cell);
  json out{{"row", row.name},
           {"paragraph", row.paragraph},
           {"car", run.cars[car]},
           {"method", run.methods[method]},
           {"speed_kmh", to_kmh(of.speed)},
           {"manual_braking", row.manual_braking},
           {"limit", eval::name(row.limit)},
           {"verdict", eval::name(result.judged.verdict)},
           {"passed", result.judged.passed()},
           {"impact_speed_mps", result.judged.impact_speed},
           {"peak_deceleration_mps2", result.judged.peak_deceleration},
           {"acted_at_s", value_of(result.acted_at)},
           {"policy", result.plan ? json(manoeuvre::name(result.plan->policy)) : json()}};
  if (of.headway) {
    out["headway_m"] = *of.headway;
    out["lead_deceleration_g"] = *of.deceleration / from_g(1.0);
  }
  if (of.impact_speed) {
    out["allowed_impact_speed_mps"] = *of.impact_speed;
  }
  if (row.limit == eval::LimitKind::deceleration) {
    out["allowed_deceleration_mps2"] = row.peak_deceleration;
  }
  if (!result.fault.empty()) {
    out["fault"] = result.fault;
  }
  return out;
}

}  // namespace

json json_of(const RegulationRun& run) {
  json out = run.meta;
  const std::string head = "suite." + run.regulation.name + ".";
  json cells = json::array();
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    const std::string place = head + run.methods[m] + ".";
    const PassCount all = passed_by(run, {.method = m});
    add(out, place, all);
    out[place + "faults"] = all.faults;
    out[place + "worst_impact_mps"] = all.worst;
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      add(out, place + run.cars[k] + ".", passed_by(run, {.method = m, .car = k}));
    }
    for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
      add(out, place + run.regulation.rows[r].name + ".", passed_by(run, {.method = m, .row = r}));
    }
    for (std::size_t k = 0; k < run.cars.size(); ++k) {
      for (std::size_t i = 0; i < run.cells.size(); ++i) {
        cells.push_back(json_of(run, k, i, m));
      }
    }
  }
  for (const RegulationRun& other : run.elsewhere) {
    add(out, head + "aeb." + other.regulation.surfaces[other.regulation.surface].name + ".",
        passed_by(other, {.method = 0}));
  }
  out[head + "n"] = run.cars.size() * run.cells.size();
  out[head + "cells"] = std::move(cells);
  return out;
}

}  // namespace saca::regulation
