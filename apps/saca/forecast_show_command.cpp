#include <fmt/core.h>

#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/printing.h"
#include "saca/lab/eval/forecast_fan.h"
#include "saca/lab/forecast_study/fan_picture.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct ShowCommand {
  suites::SuiteRequest from;  ///< `count` follows from the encounter
  std::uint64_t encounter = 0;
  std::string who;
  double at = 0.0;  ///< [s]
  std::string output;
};

int show(ShowCommand options) {
  options.from.count = static_cast<int>(options.encounter) + 1;
  const auto encounters = open_encounters(options.from, "forecast show");
  if (!encounters.has_value()) {
    return refused(encounters.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  if (options.encounter >= static_cast<std::uint64_t>(encounters.value().count)) {
    complain(fmt::format("{}: want an encounter below {}, got {}", options.from.name,
                         encounters.value().count, options.encounter));
    return bad_input;
  }
  const auto played = suites::played_encounter(
      encounters.value().at, {.seed = options.from.seed, .exact = options.from.exact},
      options.encounter);
  if (!played.has_value()) {
    return refused(played.error());
  }
  const std::string name = fmt::format("{} {}", played.value().family, options.encounter);
  const auto fan = eval::forecast_fan(played.value().stage(perceiver_of(encounters.value().inputs)),
                                      options.who, options.at);
  if (!fan.has_value()) {
    return refused({fan.error().code, fmt::format("{}: {}", name, fan.error().message)});
  }
  const std::string picture = forecast_study::fan_picture(fan.value(), options.who, name);
  if (const auto problem = long_work::write_output(options.output, picture)) {
    return refused(*problem);
  }
  app::print("{}\n", options.output);
  return success;
}

}  // namespace

void add_forecast_show(CLI::App& forecast, int& exit_code) {
  CLI::App* const command = forecast.add_subcommand(
      "show", "Draw what is forecast of one road user at one instant, and what then happened");
  const auto options = std::make_shared<ShowCommand>();
  add_encounter_options(*command, options->from);
  command->remove_option(command->get_option("--count"));
  command->add_option("--encounter", options->encounter, "Number of the encounter in it")
      ->required();
  command->add_option("--who", options->who, "car1, pedestrian2, ...")->required();
  command->add_option("--at-s", options->at, "When [s]")->required();
  command->add_option("-o,--output", options->output, "The picture (.svg)")->required();
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace saca::app
