#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/suites/suite_run.h"
#include "saca/lab/suites/thinking_options.h"

namespace saca::suites {

/// A rung, and what is lost between it and the one above.
struct Rung {
  const char* method;
  const char* above;  ///< nullptr: the top
  const char* step;   ///< what is lost or won against `above`, in words
};

/// Those that can be climbed with this memory, model and weights of V_h, each below the one that it
/// is held against.
/// @param danger  file of weights, or empty
[[nodiscard]] std::vector<Rung> rungs_with(const ThinkingOptions& thinking,
                                           const std::string& danger);

/// The methods to be run.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Rung>& rungs);

/// Regret of a rung and what its step costs.
struct RungFigures {
  Rung rung;
  eval::MethodFigures figures;
  std::optional<eval::Estimate> step;  ///< harm above that of the rung above; nullopt: the top
};

/// @param run    of names_of(rungs)
/// @param rungs  with "aeb" among them
/// @return       in their order; empty where no encounter could be played
[[nodiscard]] std::vector<RungFigures> climb(const SuiteRun& run, const std::vector<Rung>& rungs,
                                             std::uint64_t seed);

}  // namespace saca::suites
