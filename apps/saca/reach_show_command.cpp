#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/within.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/reach_study/value_picture.h"
#include "saca/lab/reach_study/value_view.h"
#include "saca/lab/report/record_page.h"
#include "saca/lab/report/value_json.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::app {
namespace {

struct ReachShowOptions {
  std::string file;
  std::string output;
  std::optional<double> speed;   // [m/s]
  std::optional<double> course;  // [deg]
  std::optional<double> time;    // [s]
  std::optional<double> zoom;    // none: so that the danger can be seen
  std::vector<std::string> at;   // name=value, in the unit that is read
};

int show(const ReachShowOptions& options) {
  if (!is_png_or_html(options.output)) {
    return wrong_command_line;
  }
  const auto at = reach_study::axis_values(options.course, options.speed, options.at);
  if (!at.has_value()) {
    complain(at.error().message);
    return wrong_command_line;
  }
  const auto solved = danger::read_solved(options.file);
  if (!solved.has_value()) {
    return refused(solved.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto view =
      reach_study::view_of(solved.value(), {at.value(), options.time, options.zoom}, options.file);
  if (!view.has_value()) {
    return refused(view.error());
  }
  const auto made = std::filesystem::path(options.output).extension() == ".png"
                        ? reach_study::value_picture(solved.value(), view.value())
                        : report::value_report(report::value_json(solved.value(), view.value()));
  if (!made.has_value()) {
    return refused(made.error());
  }
  if (const auto problem = long_work::write_output(options.output, made.value())) {
    return refused(*problem);
  }
  app::print("{}: {}\n", options.output, reach_study::described(solved.value(), view.value()));
  return success;
}

}  // namespace

void add_reach_show(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "show", "A solved value over x and y, or its first two coordinates, as PNG or HTML");
  const auto options = std::make_shared<ReachShowOptions>();
  command->add_option("FILE", options->file, "What saca reach solve left")->required();
  command
      ->add_option("--output", options->output, "A picture (.png), or a page with sliders (.html)")
      ->required();
  command->add_option("--speed-mps", options->speed, "Default: the middle of the grid's");
  command->add_option("--course-deg", options->course, "Default: 0");
  command->add_option("--time-s", options->time,
                      "A horizon that the file has; default: the longest");
  command
      ->add_option("--zoom", options->zoom,
                   "Into the middle of the plane; 1: all of it; default: shows all danger")
      ->check(within(1.0, 8.0));
  command->add_option("--at", options->at,
                      "NAME=VALUE of another axis; angles in deg, else in SI units");
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace saca::app
