#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/report/harm_chart.h"
#include "saca/lab/vehicle_study/harm_report.h"

namespace saca::app {
namespace {

struct HarmOptions {
  std::string svg;
  bool as_json = false;
};

int harm(const HarmOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  const std::filesystem::path file = places.value().root / "data" / "harm.toml";
  const auto model = prepare::read_harm(file);
  if (!model.has_value()) {
    return refused(model.error());
  }
  if (options.as_json) {
    app::print_json(vehicle_study::json_of(model.value()));
  } else {
    app::print("{}", vehicle_study::text_of(model.value(), file.string()));
  }
  if (options.svg.empty()) {
    return success;
  }
  if (const auto error = long_work::write_output(options.svg, report::harm_svg(model.value()))) {
    return refused(*error);
  }
  return success;
}

}  // namespace

void add_harm(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("harm", "How contact becomes harm: the risk curves that decisions use");
  const auto options = std::make_shared<HarmOptions>();
  command->add_option("--svg", options->svg, "Also draws the curves, with their sources, into FILE")
      ->type_name("FILE");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = harm(*options); });
}

}  // namespace saca::app
