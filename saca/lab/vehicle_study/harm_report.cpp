#include "saca/lab/vehicle_study/harm_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "saca/base/core/units.h"
#include "saca/lab/report/harm_chart.h"

namespace saca::vehicle_study {
namespace {

using nlohmann::json;

std::vector<double> told_speeds() {
  std::vector<double> speeds;
  for (const double kmh : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 80.0, 100.0}) {
    speeds.push_back(from_kmh(kmh));
  }
  return speeds;
}

/// A column of risks for each speed.
std::string risk_table(std::string_view title, const std::vector<report::HarmRisk>& risks,
                       const std::vector<double>& speeds) {
  std::string text = fmt::format("\n{:44}", title);
  for (const double speed : speeds) {
    text += fmt::format(" {:>6.0f}", to_kmh(speed));
  }
  text += "   km/h\n";
  for (const report::HarmRisk& risk : risks) {
    text += fmt::format("{:44}", risk.name);
    for (const double value : risk.values) {
      text += fmt::format(" {:6.3f}", value);
    }
    text += fmt::format("   over {}\n",
                        risk.over == report::HarmOver::delta_v ? "delta-v" : "closing speed");
  }
  return text;
}

json risks_json(const std::vector<report::HarmRisk>& risks) {
  json all = json::object();
  for (const report::HarmRisk& risk : risks) {
    all[risk.key] = risk.values;
  }
  return all;
}

}  // namespace

json json_of(const collision::HarmModel& model) {
  const std::vector<double> speeds = told_speeds();
  return {{"schema", "saca.harm/1"},
          {"speed_mps", speeds},
          {"probability", risks_json(report::injury_risks(model, speeds))},
          {"harm", risks_json(report::person_harms(model, speeds))}};
}

std::string text_of(const collision::HarmModel& model, std::string_view file) {
  const std::vector<double> speeds = told_speeds();
  return fmt::format("From {}. Probabilities are what is due to the impact.\n", file) +
         risk_table("probability", report::injury_risks(model, speeds), speeds) +
         risk_table("weighted harm of one person", report::person_harms(model, speeds), speeds);
}

}  // namespace saca::vehicle_study
