#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring {

using Calibrations = std::array<intent::Calibration, num_heads>;

/// False alarms per vehicle and hour that naming may raise: as many as the model of commit 13bf0c6
/// raised, which named the likeliest class (docs/results.md).
constexpr double most_false_alarms = 97.0;

/// The calibration of each head that suits forecasts of sequences which their model has not seen.
///
/// Sharpness and bias make the labels likeliest. That is multinomial regression on the logarithms
/// of what is predicted, with four parameters: the inverse temperature and the biases of braking
/// (FB), of going to a side (LC and RC alike) and of both (LB and RB alike); convex, solved by
/// Newton's method. Naming makes the macro F1 of `recorded_classes` greatest among factors of a
/// grid for what brakes and for what goes to a side; of the head for now only among those that
/// raise no more false alarms than `false_alarm_limit`, or else none. Everything is symmetric in
/// the mirror.
/// @param forecasts          not calibrated, one per sequence
/// @param false_alarm_limit  per vehicle and hour, >= 0
/// @throws ContractViolation  unless a frame is scored
[[nodiscard]] Calibrations best_calibrations(std::span<const Sequence> sequences,
                                             std::span<const Forecasts> forecasts,
                                             double false_alarm_limit = most_false_alarms);

/// The same forecasts, calibrated.
[[nodiscard]] Forecasts calibrated(Forecasts forecasts, const Calibrations& calibrations);

/// Forecasts by cross-validation, each split's calibrated on all other splits: no label of a split
/// touches what is predicted of it. So any model can be compared with ours.
/// @param splits     one per sequence, at least two different ones
/// @param forecasts  not calibrated, one per sequence
[[nodiscard]] std::vector<Forecasts> cross_calibrated(std::span<const Sequence> sequences,
                                                      std::span<const std::string> splits,
                                                      std::vector<Forecasts> forecasts);

}  // namespace saca::intention_scoring
