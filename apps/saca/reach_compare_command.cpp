#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/within.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/reach_study/authors_report.h"
#include "saca/lab/verification/authors_network.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using reach_study::AuthorsRequest;

struct CompareOptions {
  std::string file;
  std::string network;
  std::string output = "reach/authors_network.html";
  std::vector<double> speeds_mps;
  std::optional<double> course_deg;
  bool as_json = false;
};

int compare_values(const CompareOptions& options) {
  if (!is_png_or_html(options.output)) {
    return wrong_command_line;
  }
  const auto solved = danger::read_solved(options.file);
  if (!solved.has_value()) {
    return refused(solved.error());
  }
  if (const auto problem = reach_study::why_not_comparable(solved.value(), options.file)) {
    return refused(*problem);
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto network = verification::read_authors_network(options.network);
  if (!network.has_value()) {
    return refused(network.error());
  }
  const bool as_picture = fs::path(options.output).extension() == ".png";
  const auto report = reach_study::authors_report(
      solved.value(), network.value(),
      {.file = options.file,
       .network_name = fs::path(options.network).filename().string(),
       .views = reach_study::authors_views(options.speeds_mps, options.course_deg),
       .format = as_picture ? AuthorsRequest::Format::picture : AuthorsRequest::Format::page});
  if (!report.has_value()) {
    return refused(report.error());
  }
  if (const auto problem = long_work::write_output(options.output, report.value().drawn)) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(reach_study::json_of(report.value().found));
    return success;
  }
  app::print("{}", reach_study::text_of(report.value().found));
  app::print("Maps: {}\n", fs::absolute(options.output).string());
  return success;
}

}  // namespace

void add_reach_compare(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "compare", "Hold the value network that the paper's authors published to a solved value");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("file", options->file, "Solved values beside an obstacle at rest (HDF5)")
      ->required();
  command->add_option("--network", options->network, "The published safe_value_params.npz")
      ->required();
  command->add_option("--output", options->output, "The page (.html), or its maps alone (.png)")
      ->capture_default_str();
  command
      ->add_option("--speed-mps", options->speeds_mps,
                   "Of the pairs of maps; default: some of each")
      ->check(within(0.0, 18.0));
  command->add_option("--course-deg", options->course_deg, "Likewise, one for all")
      ->check(within(-40.0, 40.0));
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = compare_values(*options); });
}

}  // namespace saca::app
