#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "saca/base/formats/tensors.h"
#include "saca/lab/danger_study/margin_count.h"
#include "saca/lab/learned_danger/margins.h"

namespace saca::danger_study {

/// What a count shows: of each bin its margin and what it was counted from.
struct MarginReport {
  int situations = 0;
  std::array<std::optional<double>, learned_danger::num_bins> margins;  ///< [m]; nullopt: none is
                                                                        ///< shown to be enough
  std::array<learned_danger::Share, learned_danger::num_bins> hits;     ///< of what is told safe
                                                                        ///< without one
};

[[nodiscard]] MarginReport margin_report(const MarginCount& count);

/// danger.net.BIN.margin_m (Margins::none where there is none) and .told_safe.
[[nodiscard]] nlohmann::json json_of(const MarginReport& report);

/// A line for each bin.
[[nodiscard]] std::string text_of(const MarginReport& report);

/// The same weights with these margins among their words.
[[nodiscard]] formats::Tensors with_margins(formats::Tensors weights, const MarginReport& report);

}  // namespace saca::danger_study
