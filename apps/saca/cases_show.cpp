#include <memory>
#include <string>

#include "apps/saca/cases_commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/cases/cases_page.h"
#include "saca/lab/cases/example_source.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct CasesShowOptions {
  cases::ShownOptions shown;
  std::string car = "compact_rwd_ev";
  std::string output = "runs/crash_cases.html";
  bool as_json = false;
};

int show_cases(const CasesShowOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto file = cases::read_cases(options.shown.file);
  if (!file.has_value()) {
    return refused(file.error());
  }
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const std::vector<cases::CrashCase>& all = file.value().cases;
  const auto shown = cases::shown_cases(all, options.shown);
  if (!shown.has_value()) {
    return refused(shown.error());
  }
  const auto page =
      cases::cases_page(shown.value(), all, options.shown,
                        {.car_name = inputs.value().car_name,
                         .forecast = {.car = &inputs.value().car, .harm = &inputs.value().harm}});
  if (!page.has_value()) {
    return refused(page.error());
  }
  if (const auto problem =
          long_work::write_output(options.output, report::suite_page(page.value()))) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(
        cases::cases_page_json(shown.value(), options.shown.file, options.output, all.size()));
  } else {
    app::print("{}: {} of {} cases\n", options.output, shown.value().size(), all.size());
  }
  return success;
}

}  // namespace

void add_cases_show(CLI::App& cases, int& exit_code) {
  CLI::App* const command =
      cases.add_subcommand("show", "Cases with their pictures, facts, assumptions and harms");
  const auto options = std::make_shared<CasesShowOptions>();
  command->add_option("FILE", options->shown.file, "What `build` wrote")->required();
  command->add_option("--count", options->shown.count, "How many are drawn")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seed", options->shown.seed, "By which they are drawn")
      ->capture_default_str();
  command->add_option("--family", options->shown.family, "Only of this family");
  command->add_option("--record", options->shown.record,
                      "Only of this record, e.g. fars_2016_40001");
  command->add_option("--car", options->car, "That they were made for")->capture_default_str();
  command->add_option("--output,-o", options->output, "The page (HTML)")->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = show_cases(*options); });
}

}  // namespace saca::app
