#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/eval/calibration.h"
#include "saca/lab/eval/suite_figures.h"

namespace saca::eval {

/// One way to choose that a language model is compared with, or one way to ask it.
struct ScoredChoice {
  std::string_view key;     ///< as files have it
  std::string_view title;   ///< for readers
  std::string_view method;  ///< of methods(), run with the model and without memory
};

/// All that there are, in the order of tables: the model asked with and without our facts, heard at
/// once and after reasoning, checked or not; then the best forecast, braking, the best in
/// hindsight.
[[nodiscard]] std::span<const ScoredChoice> scored_choices();

/// The methods of scored_choices(), in their order: the suite in which a model is scored.
[[nodiscard]] std::vector<std::string> scored_methods();

/// How well a language model chooses in closed loop.
struct ModelScore {
  std::vector<MethodFigures> choices;      ///< in the order of scored_choices()
  std::optional<Calibration> calibration;  ///< of its last answers with facts; nullopt: it never
                                           ///< answered about what came
};

/// @param rows  of a suite with scored_methods(); at least one of them could be played
/// @param seed  of the intervals
[[nodiscard]] ModelScore model_score(std::span<const SuiteRow> rows, std::uint64_t seed);

}  // namespace saca::eval
