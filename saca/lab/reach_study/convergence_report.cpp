#include "saca/lab/reach_study/convergence_report.h"

#include <fmt/core.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <utility>

#include "saca/lab/report/chart_svg.h"

namespace saca::reach_study {
namespace {

using report::ChartColour;
using verification::Refinement;

/// "a_wave_carried_along_weno5"
std::string figure_name(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  return text;
}

}  // namespace

nlohmann::json json_of(const std::vector<Refinement>& all) {
  nlohmann::json figures;
  for (const Refinement& one : all) {
    const std::string name = "reach.check." + figure_name(one.name);
    figures[name + ".order"] = orders(one).back();
    figures[name + ".error_m"] = one.errors.back();
  }
  return figures;
}

std::string text_of(const std::vector<Refinement>& all) {
  std::string text;
  for (const Refinement& one : all) {
    text += fmt::format("{:32} mean error {:.2e} m at {:.4f} m, order {:.2f}\n", one.name,
                        one.errors.back(), one.spacings.back(), orders(one).back());
  }
  return text;
}

std::string convergence_chart(const std::vector<Refinement>& all) {
  constexpr std::array colours{ChartColour::blue,   ChartColour::orange, ChartColour::green,
                               ChartColour::purple, ChartColour::blue,   ChartColour::orange,
                               ChartColour::green};
  const auto chart = [&](std::string title, std::size_t first, std::size_t end) {
    report::LineChart made{.title = std::move(title),
                           .x = {"log10 of the spacing", "", -2.0, 0.0},
                           .y = {"log10 of the mean error", "", -10.0, 0.0},
                           .curves = {}};
    for (std::size_t i = first; i < end; ++i) {
      report::ChartLine line{.name = all[i].name,
                             .note = fmt::format("order {:.2f} in the end", orders(all[i]).back()),
                             .colour = colours.at(i)};
      for (std::size_t k = all[i].errors.size(); k-- > 0;) {
        line.points.push_back({std::log10(all[i].spacings[k]), std::log10(all[i].errors[k])});
      }
      made.curves.push_back(std::move(line));
    }
    return made;
  };
  return report::chart_svg({.heading = "Errors against known answers, on ever finer grids",
                            .lines = {"saca reach check: doubles, TVD-RK3"},
                            .charts = {chart("Smooth", 0, 4), chart("With kinks", 4, all.size())}});
}

}  // namespace saca::reach_study
