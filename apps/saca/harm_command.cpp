#include "apps/saca/options.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/report/harm_chart.h"
#include "saca/lab/vehicle_study/harm_report.h"

namespace saca::app {
namespace {

struct HarmOptions {
  std::string svg;
  bool as_json = false;
};

void tell_harm(const HarmOptions& options) {
  const fs::path file = here().root / "data" / "harm.toml";
  const auto model = need(prepare::read_harm(file));
  tell(options.as_json, vehicle_study::json_of(model),
       vehicle_study::text_of(model, file.string()));
  if (!options.svg.empty()) {
    write(options.svg, report::harm_svg(model));
  }
}

}  // namespace

void add_harm(CLI::App& line) {
  const auto [command, options] = add_command<HarmOptions>(
      line, "harm", "How contact becomes harm: the risk curves that decisions use", tell_harm);
  add(command, "--svg", options.svg, "Also draws the curves, with their sources, into FILE")
      ->type_name("FILE");
  add_json(command, options.as_json);
}

}  // namespace saca::app
