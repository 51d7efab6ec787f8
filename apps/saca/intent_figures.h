#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/training/bootstrap.h"
#include "saca/lab/training/displacement.h"
#include "saca/lab/training/evaluation.h"

/// The figures of `saca intent eval` as tables and as JSON (schema saca.intent_eval/1).
namespace saca::app {

/// One way to predict and its figures.
struct Row {
  std::string method;
  training::Figures figures;
  /// Our macro F1 less its, and our logarithmic loss less its.
  std::array<std::optional<training::Interval>, training::num_heads> macro_f1_difference;
  std::array<std::optional<training::Interval>, training::num_heads> log_loss_difference;
};

void tell_table(const std::string& title, const std::vector<Row>& rows);
/// Its confusion at each horizon.
void tell_confusion(const Row& row);
/// What of each act it finds, and when.
void tell_acts(const Row& row);
/// Ours less it, at each horizon.
void tell_difference(const Row& row);
void tell_displacements(const training::Displacements& found);

[[nodiscard]] nlohmann::json row_json(const Row& row);
[[nodiscard]] nlohmann::json displacements_json(const training::Displacements& found);

}  // namespace saca::app
