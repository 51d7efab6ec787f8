#include <memory>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/reach_study/convergence_report.h"
#include "saca/lab/verification/convergence.h"

namespace saca::app {
namespace {

struct CheckOptions {
  int grids = 4;
  std::string picture;
  bool as_json = false;
};

int check(const CheckOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.picture})) {
    return refused(*problem);
  }
  const std::vector<verification::Refinement> all =
      verification::refinements(options.grids, usual_threads());
  if (options.as_json) {
    app::print_json(reach_study::json_of(all));
  } else {
    app::print("{}", reach_study::text_of(all));
  }
  if (options.picture.empty()) {
    return success;
  }
  const auto problem =
      long_work::write_output(options.picture, reach_study::convergence_chart(all));
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
