#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/figures_output.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/settings.h"
#include "apps/saca/within.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/cases/case_set.h"
#include "saca/lab/cases/case_tally.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct CasesBuildOptions {
  std::vector<std::string> folders;  ///< releases of FARS
  std::string hundred_car;
  std::optional<int> count;
  std::string car = "compact_rwd_ev";
  cases::CaseMakingOptions making;
  cases::CaseOutputs outputs{.cases = "runs/crash_cases.jsonl"};
  std::string journal;
  int threads = usual_threads();
  bool as_json = false;
};

std::string command_of(const CasesBuildOptions& options) {
  return fmt::format("cases build --car {} --seed {} --draws {} --told-draws {} --tries {}{}",
                     options.car, options.making.seed, options.making.judging.draws,
                     options.making.judging.told_draws, options.making.tries,
                     options.count ? fmt::format(" --count {}", *options.count) : "");
}

/// All rows; nullopt: interrupted.
Result<std::optional<std::vector<cases::CaseRow>>> rows_of(const CasesBuildOptions& options,
                                                           const cases::CaseSources& sources,
                                                           Inputs inputs) {
  const auto planes = open_planes(std::move(inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  const PlanesOfCar& with = *planes.value();
  const cases::CaseMaking making(options.making, sources,
                                 {.car_name = with.inputs.car_name,
                                  .forecast = with.setup.forecast,
                                  .intent = &with.inputs.intent});
  return cases::case_rows(
      making,
      {.journal = options.journal.empty() ? options.outputs.cases + ".journal" : options.journal,
       .title = fmt::format("saca {} {}", version_text(), command_of(options)),
       .display = progress_display(),
       .threads = options.threads});
}

int build_cases(const CasesBuildOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable(
          {options.outputs.cases, options.outputs.memory, options.outputs.drivers})) {
    return refused(*problem);
  }
  if (options.folders.empty() && options.hundred_car.empty()) {
    complain("want folders with releases of FARS, or --hundred-car; got neither");
    return wrong_command_line;
  }
  if (!options.outputs.drivers.empty() && options.hundred_car.empty()) {
    complain("--drivers: want --hundred-car, too: no other drivers were recorded");
    return wrong_command_line;
  }
  long_work::watch_for_interrupt();
  auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto sources = cases::open_case_sources(inputs.value().places.root, options.folders,
                                                options.hundred_car, options.count);
  if (!sources.has_value()) {
    return refused(sources.error());
  }
  auto gathered = rows_of(options, sources.value(), std::move(inputs).value());
  if (!gathered.has_value()) {
    return refused(gathered.error());
  }
  if (!gathered.value()) {
    complain("interrupted: the same command goes on from here");
    return was_interrupted;
  }
  std::vector<cases::CaseRow> rows = *std::move(gathered).value();
  const cases::FamilyTallies tallies = cases::family_tallies(sources.value(), rows);
  const cases::CaseSet set = cases::case_set(std::move(rows));
  complain_of(set.problems);
  if (const auto problem = cases::write_cases(options.outputs, set.cases)) {
    return refused(*problem);
  }
  if (options.as_json) {
    print_with_meta(cases::tally_json(sources.value(), tallies, set), command_of(options));
  } else {
    app::print("{}", cases::tally_text(sources.value(), tallies, set, options.outputs.cases));
  }
  return set.problems.empty() ? success : some_failed;
}

}  // namespace

void add_cases_build(CLI::App& cases, int& exit_code) {
  CLI::App* const command =
      cases.add_subcommand("build", "Makes cases of recorded crashes: FARS, and the 100-Car study");
  const auto options = std::make_shared<CasesBuildOptions>();
  command->add_option("FOLDER", options->folders,
                      "Releases of FARS: accident.csv, vehicle.csv and person.csv in each");
  command->add_option("--hundred-car", options->hundred_car,
                      "Folder of the 100-Car study's release: its emergencies, too");
  command->add_option("--count", options->count, "At most so many crashes, of the families in turn")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  command->add_option("--seed", options->making.seed, "Of all that is drawn: same seed, same bytes")
      ->capture_default_str();
  command
      ->add_option("--draws", options->making.judging.draws,
                   "Of what is left to chance, that harm is the mean of")
      ->check(CLI::Range(2, 1'000))
      ->capture_default_str();
  command
      ->add_option("--told-draws", options->making.judging.told_draws,
                   "Of the verdict, that expected harm is the mean of")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command
      ->add_option("--tries", options->making.tries,
                   "Samples of a record's family until its crash happens without avoidance")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_option("--output,-o", options->outputs.cases, "Where the cases go")
      ->capture_default_str();
  command->add_option("--for-memory", options->outputs.memory,
                      "Besides, without their records, for `saca memory import`");
  command->add_option("--drivers", options->outputs.drivers,
                      "Besides, of the study's events alone, with what the driver did in the place "
                      "of what was best: for saca-train-imitator, not for a memory");
  command->add_option("--journal", options->journal,
                      "What was found so far (default: beside the output)");
  add_threads(*command, options->threads);
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = build_cases(*options); });
}

}  // namespace saca::app
