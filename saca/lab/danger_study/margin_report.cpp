#include "saca/lab/danger_study/margin_report.h"

#include <fmt/core.h>

#include <cstddef>
#include <utility>

namespace saca::danger_study {

using learned_danger::Margins;
using learned_danger::num_bins;

MarginReport margin_report(const MarginCount& count) {
  MarginReport report{.situations = count.situations, .margins = {}, .hits = {}};
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    report.margins[bin] = count.told[bin].margin();
    report.hits[bin] = count.told[bin].hits_with(0);
  }
  return report;
}

nlohmann::json json_of(const MarginReport& report) {
  nlohmann::json all;
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    const std::string place = "danger.net." + learned_danger::bin_names()[bin] + ".";
    all[place + "margin_m"] = report.margins[bin].value_or(Margins::none);
    all[place + "told_safe"] = report.hits[bin].of;
  }
  return all;
}

std::string text_of(const MarginReport& report) {
  std::string text;
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    const auto& margin = report.margins[bin];
    text += fmt::format("{:42} {:>7} of {:6} told safe {:5} were hit\n",
                        learned_danger::bin_names()[bin],
                        margin ? fmt::format("{:.2f} m", *margin) : "none", report.hits[bin].of,
                        report.hits[bin].count);
  }
  return text;
}

formats::Tensors with_margins(formats::Tensors weights, const MarginReport& report) {
  std::array<double, num_bins> metres{};
  for (std::size_t bin = 0; bin < num_bins; ++bin) {
    metres[bin] = report.margins[bin].value_or(Margins::none);
  }
  Margins(metres).add_to(weights.words);
  weights.words["margin.situations"] = std::to_string(report.situations);
  return weights;
}

}  // namespace saca::danger_study
