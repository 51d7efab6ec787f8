#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/saca/danger_check.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/units.h"
#include "saca/lab/danger_study/beside_exact.h"
#include "saca/lab/danger_study/weights.h"
#include "saca/lab/learned_danger/point_mass.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

struct DangerShowOptions {
  std::string weights;
  std::string table;
  std::string output = "reach/learnt.png";
  std::vector<double> speeds_mps{10.0, 18.0};
  double course_deg = 0.0;
};

int show_danger(const DangerShowOptions& options) {
  if (fs::path(options.output).extension() != ".png") {
    complain(fmt::format("--output: want a name that ends in .png, got '{}'", options.output));
    return wrong_command_line;
  }
  const auto weights = danger_study::read_network(options.weights);
  if (!weights.has_value()) {
    return refused(weights.error());
  }
  const auto exact = learned_danger::read_exact_point_mass(options.table);
  if (!exact.has_value()) {
    return refused(exact.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto picture = danger_study::beside_exact_png(weights.value(), exact.value(),
                                                      {.weights = options.weights,
                                                       .table = options.table,
                                                       .speeds = options.speeds_mps,
                                                       .course = from_degrees(options.course_deg)});
  if (!picture.has_value()) {
    return refused(picture.error());
  }
  if (const auto unwritable = long_work::write_output(options.output, picture.value())) {
    return refused(*unwritable);
  }
  app::print("{}\n", fs::absolute(options.output).string());
  return success;
}

}  // namespace

void add_danger_show(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<DangerShowOptions>();
  CLI::App* const command = danger.add_subcommand(
      "show", "Draw learnt V_h, without its margins, beside the exact value of a point mass");
  command->add_option("WEIGHTS", options->weights, "safetensors file")->required();
  command
      ->add_option("--table", options->table,
                   "Solved values beside an obstacle at rest (`saca reach solve`)")
      ->required();
  command->add_option("--output", options->output, "A picture (.png)")->capture_default_str();
  command->add_option("--speed-mps", options->speeds_mps, "A row of maps for each")
      ->check(within(0.0, 40.0))
      ->capture_default_str();
  command->add_option("--course-deg", options->course_deg, "Of the ego, one for all")
      ->check(within(-180.0, 180.0))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = show_danger(*options); });
}

}  // namespace saca::app
