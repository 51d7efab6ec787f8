#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "saca/lab/model_trials/bench.h"

namespace saca::model_trials {

/// Figures of `saca model bench` (docs/formats.md), in the order in which they are told.
struct BenchFigures {
  std::vector<std::pair<std::string, double>> numbers;     ///< names begin with "reason."
  std::vector<std::pair<std::string, std::string>> texts;  ///< names begin with "meta."
};

/// Where three at a time never had all their answers in time, their times are missing; where the
/// model is no child process, so is what it measures itself.
/// @param model  that was asked; a child process is asked how much memory it takes
/// @param clock  of the model
[[nodiscard]] BenchFigures bench_figures(const Bench& bench, language_model::LanguageModel& model,
                                         const Clock& clock);

/// One flat object.
[[nodiscard]] nlohmann::ordered_json bench_json(const BenchFigures& figures);
/// A line each.
[[nodiscard]] std::string bench_text(const BenchFigures& figures);

}  // namespace saca::model_trials
