#include "apps/saca/moment_option.h"

#include <fmt/core.h>

#include "apps/saca/within.h"
#include "saca/lab/eval/decision_point.h"

namespace saca::app {

void add_at(CLI::App& command, std::optional<double>& at) {
  command.add_option("--at-s", at, "When they begin (default: at the trigger)")
      ->check(within(0.0, 600.0, "s"));
}

Result<std::optional<double>> decision_time(const ScenarioInputs& inputs,
                                            const std::optional<double>& at) {
  if (at) {
    if (*at > inputs.scenario.duration) {
      return Error{Error::Code::out_of_range,
                   fmt::format("--at-s {}: {} ends at {} s", *at, inputs.scenario.name,
                               inputs.scenario.duration)};
    }
    return at;
  }
  const auto trigger = eval::trigger_time(inputs.scenario, inputs.car);
  if (!trigger) {
    complain(inputs.scenario.name +
             ": nothing comes within T1 of a conflict, so nothing is to be decided; say when with "
             "--at-s");
  }
  return trigger;
}

}  // namespace saca::app
