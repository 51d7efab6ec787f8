#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/saca/inputs.h"
#include "apps/saca/suite_sources.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/scenario/chance.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::app {

/// An encounter as forecasts are held against it: with the draws and the perception of a suite.
struct PlayedEncounter {
  std::string family;
  scenario::Scenario world;
  scenario::Chance chance;
  std::optional<scenario::Scenario> twin;  ///< the same without risk, where there is one

  /// Refer to this and to the inputs; the second to the twin, which must be there.
  [[nodiscard]] encounter::Stage stage(const Inputs& inputs) const;
  [[nodiscard]] encounter::Stage twin_stage(const Inputs& inputs) const;
};
[[nodiscard]] Result<PlayedEncounter> played_encounter(const SuiteEncounters& encounters,
                                                       const SuiteCommandOptions& options,
                                                       std::uint64_t number);

/// Which encounters, and what is drawn in them.
void add_encounter_options(CLI::App& command, SuiteCommandOptions& from);

/// `saca forecast show`.
void add_forecast_show(CLI::App& forecast, int& exit_code);

}  // namespace saca::app
