#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/report/harm_chart.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct HarmOptions {
  std::string svg;
  bool as_json = false;
};

/// A column of risks for each speed.
void print_table(const std::string& title, const std::vector<report::HarmRisk>& risks,
                 const std::vector<double>& speeds) {
  app::print("\n{:44}", title);
  for (const double speed : speeds) {
    app::print(" {:>6.0f}", to_kmh(speed));
  }
  app::print("   km/h\n");
  for (const report::HarmRisk& risk : risks) {
    app::print("{:44}", risk.name);
    for (const double value : risk.values) {
      app::print(" {:6.3f}", value);
    }
    app::print("   over {}\n",
               risk.over == report::HarmOver::delta_v ? "delta-v" : "closing speed");
  }
}

json table_json(const std::vector<report::HarmRisk>& risks) {
  json all = json::object();
  for (const report::HarmRisk& risk : risks) {
    all[risk.key] = risk.values;
  }
  return all;
}

int harm(const HarmOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    complain(places.error().message);
    return bad_input;
  }
  const std::filesystem::path file = places.value().root / "data" / "harm.toml";
  const auto model = prepare::read_harm(file);
  if (!model.has_value()) {
    complain(model.error().message);
    return bad_input;
  }
  std::vector<double> speeds;
  for (const double kmh : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 80.0, 100.0}) {
    speeds.push_back(from_kmh(kmh));
  }
  const auto risks = report::injury_risks(model.value(), speeds);
  const auto harms = report::person_harms(model.value(), speeds);
  if (options.as_json) {
    const json out{{"schema", "saca.harm/1"},
                   {"speed_mps", speeds},
                   {"probability", table_json(risks)},
                   {"harm", table_json(harms)}};
    app::print_json(out);
  } else {
    app::print("From {}. Probabilities are what is due to the impact.\n", file.string());
    print_table("probability", risks, speeds);
    print_table("weighted harm of one person", harms, speeds);
  }
  if (options.svg.empty()) {
    return success;
  }
  if (const auto error = long_work::write_output(options.svg, report::harm_svg(model.value()))) {
    complain(error->message);
    return cannot_write;
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
