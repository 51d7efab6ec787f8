#include "saca/lab/vehicle_study/fit_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace saca::vehicle_study {

using nlohmann::json;

json json_of(const FitResult& result) {
  json parameters = json::array();
  for (const tune::FittedParameter& one : result.fit.parameters) {
    const auto bound = [&one](double value) { return one.determined ? json(value) : json(); };
    parameters.push_back({{"section", one.section},
                          {"key", one.key},
                          {"base", one.base},
                          {"value", one.value},
                          {"determined", one.determined},
                          {"low", bound(one.low)},
                          {"high", bound(one.high)}});
  }
  json signals = json::array();
  for (const tune::SignalQuality& one : result.fit.signals) {
    signals.push_back({{"log", one.log},
                       {"column", tune::info(one.signal).column},
                       {"noise", one.noise},
                       {"rms", one.rms},
                       {"offset", one.offset},
                       {"run", one.run},
                       {"outliers", one.num_outliers}});
  }
  return {
      {"schema", "saca.vehicle_fit/1"}, {"car", result.car},  {"output", result.output},
      {"parameters", parameters},       {"signals", signals}, {"condition", result.fit.condition},
      {"warnings", result.fit.warnings}};
}

std::string text_of(const FitResult& result) {
  std::string text =
      fmt::format("{:<26} {:>9} {:>9}   {}\n", "parameter", "base", "fitted", "95 % interval");
  for (const tune::FittedParameter& one : result.fit.parameters) {
    const std::string name = fmt::format("{}.{}", one.section, one.key);
    if (one.determined) {
      text += fmt::format("{:<26} {:>9.4g} {:>9.4g}   {:.4g} to {:.4g}\n", name, one.base,
                          one.value, one.low, one.high);
    } else {
      text += fmt::format("{:<26} {:>9.4g} {:>9}   the logs do not determine it\n", name, one.base,
                          "-");
    }
  }
  text +=
      fmt::format("\n{:<26} {:>9} {:>9} {:>9}   {}\n", "signal", "rms", "noise", "offset", "log");
  for (const tune::SignalQuality& one : result.fit.signals) {
    text += fmt::format("{:<26} {:>9.2g} {:>9.2g} {:>9.2g}   {}\n", tune::info(one.signal).column,
                        one.rms, one.noise, one.offset, one.log);
  }
  return text + fmt::format("\n{}: the car as fitted; the grip is the road's and not in it\n",
                            result.output);
}

}  // namespace saca::vehicle_study
