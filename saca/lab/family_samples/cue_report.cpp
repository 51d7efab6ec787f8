#include "saca/lab/family_samples/cue_report.h"

#include <fmt/core.h>

#include "saca/base/core/proportion.h"
#include "saca/lab/eval/estimate_text.h"

namespace saca::family_samples {

using eval::with_interval;
using nlohmann::json;
using world::CueKind;
using world::num_cue_kinds;

json json_of(const eval::CueCounts& counts) {
  json figures = json::object();
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const std::string key = fmt::format("cues.{}.", name(static_cast<CueKind>(k)));
    figures[key + "there"] = counts.at(k).there;
    figures[key + "came"] = counts.at(k).came;
  }
  return figures;
}

json json_of(std::string_view suite, std::span<const eval::CueForecast> forecasts) {
  json figures = json::object();
  for (const eval::CueForecast& one : forecasts) {
    const std::string key = fmt::format("cues.{}.{}.", suite, one.key);
    eval::add_estimate(figures, key + "log_loss", one.log_loss);
    eval::add_estimate(figures, key + "brier", one.brier);
  }
  return figures;
}

std::string text_of(const eval::CueCounts& counts) {
  std::string text =
      fmt::format("{:18} {:>6} {:>6} {:>24}\n", "cue", "there", "came", "share (95 %)");
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const eval::CueCount& one = counts.at(k);
    if (one.there > 0) {
      const Proportion share = proportion(one.came, one.there);
      text += fmt::format(
          "{:18} {:6} {:6} {:>24}\n", name(static_cast<CueKind>(k)), one.there, one.came,
          fmt::format("{:.3f} ({:.3f} to {:.3f})", share.share, share.low, share.high));
    }
  }
  return text;
}

std::string text_of(std::string_view suite, std::span<const eval::CueForecast> forecasts) {
  std::string text =
      fmt::format("\n{:34} {:>26} {:>26}\n", fmt::format("suite {}, calibration split", suite),
                  "log loss", "Brier score");
  for (const eval::CueForecast& one : forecasts) {
    text += fmt::format("{:34} {:>26} {:>26}\n", one.title, with_interval(one.log_loss, 4),
                        with_interval(one.brier, 4));
  }
  return text;
}

}  // namespace saca::family_samples
