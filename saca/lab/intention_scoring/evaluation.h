#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/bootstrap.h"
#include "saca/lab/intention_scoring/lead_time.h"
#include "saca/lab/intention_scoring/manoeuvre_events.h"
#include "saca/lab/intention_scoring/score.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/thinking/intent/model.h"

namespace saca::intention_scoring {

/// All figures of one way to predict.
struct Figures {
  std::array<Tally, num_heads> tallies;
  std::array<std::optional<Interval>, num_heads> macro_f1;  ///< groups drawn anew
  ManoeuvreEventsFound events;
  LeadTimes lane_changes;
  LeadTimes brakings;
  FalseAlarms alarms;
  std::size_t illegal_steps = 0;  ///< of what the head for now names
};

/// @param classes  over which macro F1 is taken
/// @param seed     of the groups that are drawn
[[nodiscard]] Figures figures_of(std::span<const Sequence> sequences,
                                 std::span<const Forecasts> forecasts,
                                 std::span<const std::size_t> classes, std::uint64_t seed);

/// Macro F1 of the first way less that of the second, by the paired bootstrap.
[[nodiscard]] std::optional<Interval> macro_f1_difference(std::span<const Sequence> sequences,
                                                          std::span<const Forecasts> first,
                                                          std::span<const Forecasts> second,
                                                          std::size_t head,
                                                          std::span<const std::size_t> classes,
                                                          std::uint64_t seed);

/// Likewise the mean logarithmic loss of the first way less that of the second.
[[nodiscard]] std::optional<Interval> log_loss_difference(std::span<const Sequence> sequences,
                                                          std::span<const Forecasts> first,
                                                          std::span<const Forecasts> second,
                                                          std::size_t head, std::uint64_t seed);

/// Steps that intent::may_follow forbids.
[[nodiscard]] ForbiddenSteps structurally_forbidden();

/// Models by what they have not seen: a split or a site, or "nothing".
using ModelsByLeftOut = std::map<std::string, intent::Model>;

/// All safetensors files of a folder, by their word `left_out`.
/// @return  unreadable when there is none, malformed when one is none of ours or two say the same
[[nodiscard]] Result<ModelsByLeftOut> read_models(const std::filesystem::path& folder);

/// Forecasts of the sequences by the models that have not seen their split: cross-validation.
/// @param splits  one per sequence
/// @return        out_of_range, naming the split, when a model is missing
[[nodiscard]] Result<std::vector<Forecasts>> predicted_unseen(const ModelsByLeftOut& models,
                                                              std::span<const Sequence> sequences,
                                                              std::span<const std::string> splits,
                                                              int threads);

}  // namespace saca::intention_scoring
