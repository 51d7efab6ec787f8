#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/chart_svg.h"
#include "saca/lab/verification/convergence.h"

namespace saca::app {
namespace {

using report::ChartColour;
using verification::Refinement;

struct CheckOptions {
  int grids = 4;
  std::string picture;
  bool as_json = false;
};

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

std::string convergence_picture(const std::vector<Refinement>& all) {
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
                             .colour = colours[i]};
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

int check(const CheckOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.picture})) {
    return refused(*problem);
  }
  const std::vector<Refinement> all = verification::refinements(options.grids, usual_threads());
  nlohmann::json figures;
  for (const Refinement& one : all) {
    const std::string name = "reach.check." + figure_name(one.name);
    const double order = orders(one).back();
    figures[name + ".order"] = order;
    figures[name + ".error_m"] = one.errors.back();
    if (!options.as_json) {
      app::print("{:32} mean error {:.2e} m at {:.4f} m, order {:.2f}\n", one.name,
                 one.errors.back(), one.spacings.back(), order);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
  }
  if (options.picture.empty()) {
    return success;
  }
  auto problem = long_work::write_output(options.picture, convergence_picture(all));
  return problem ? refused(*problem) : success;
}

}  // namespace

void add_reach_check(CLI::App& reach, int& exit_code) {
  CLI::App* const command =
      reach.add_subcommand("check", "Hold the solver to known answers on ever finer grids");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("--grids", options->grids, "How many, each with half the spacing")
      ->check(CLI::Range(2, 5))
      ->capture_default_str();
  command->add_option("--picture", options->picture, "SVG of errors over spacings");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace saca::app
