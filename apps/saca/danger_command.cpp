#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/stopped.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/danger_study/danger_model.h"
#include "saca/lab/danger_study/data_set.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

using danger_study::TableUse;

struct DatasetOptions {
  std::string folder;
  std::string car = "compact_rwd_ev";
  std::int64_t transitions = 31'000'000;
  std::uint64_t seed = 1;
  int drives_per_part = 500;
  bool no_tables = false;
  std::string by;  ///< weights; empty: none
  bool outcomes = false;
  int threads = usual_threads();
  bool as_json = false;
};

/// The networks by which evasions are driven, of this car.
Result<std::optional<learned_danger::Network>> network_by(const std::string& path,
                                                          const std::string& car) {
  if (path.empty()) {
    return std::optional<learned_danger::Network>();
  }
  auto weights = read_danger_weights(path);
  if (!weights.has_value()) {
    return weights.error();
  }
  if (weights.value().inputs.car_name != car) {
    return Error{Error::Code::malformed, fmt::format("{}: want weights of the car {}, got of {}",
                                                     path, car, weights.value().car_name)};
  }
  return std::optional(std::move(weights).value().network);
}

int make_dataset(const DatasetOptions& options) {
  long_work::watch_for_interrupt();
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  auto network = network_by(options.by, inputs.value().car_name);
  if (!network.has_value()) {
    return refused(network.error());
  }
  const danger_study::DataSetTask task{
      .folder = options.folder,
      .car_as_asked_for = options.car,
      .car = {inputs.value().car_name, inputs.value().car},
      .transitions = options.transitions,
      .seed = options.seed,
      .drives_per_part = options.drives_per_part,
      .tables = options.no_tables ? TableUse::none : TableUse::solved,
      .network = std::move(network).value(),
      .outcomes = options.outcomes,
      .threads = options.threads,
      .display = progress_display()};
  auto opened = danger_study::DataSet::open(task);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  const auto model = danger_study::model_of_drawn(danger_sources(inputs.value()), task.tables);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const SteadyClock clock;
  const auto start = clock.now();
  danger_study::DataSet set = std::move(opened).value();
  const auto all = set.make(model.value());
  if (!all.has_value()) {
    return stopped(all.error());
  }
  if (options.as_json) {
    print_json(danger_study::json_of(task, all.value(), to_seconds(clock.now() - start)));
  } else {
    app::print("{}", danger_study::text_of(task, all.value()));
  }
  return success;
}

}  // namespace

void add_danger(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "danger", "V_h and Q_h, learnt: what they are learnt from, and what they are worth");
  command->require_subcommand(1);
  const auto options = std::make_shared<DatasetOptions>();
  CLI::App* const dataset = command->add_subcommand(
      "dataset", "Simulate transitions of the full vehicle beside obstacles; can be interrupted");
  dataset->add_option("FOLDER", options->folder, "Of the parts; made if it is not there")
      ->required();
  dataset->add_option("--transitions", options->transitions, "At least so many")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
      ->capture_default_str();
  dataset->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  dataset->add_option("--seed", options->seed)->capture_default_str();
  dataset->add_option("--part-drives", options->drives_per_part, "Drives of the ego in a part")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  dataset->add_flag(
      "--no-tables", options->no_tables,
      "Look for the boundary and the way out by arcs, not by solved tables of danger");
  dataset->add_option("--by", options->by,
                      "Weights of saca-train-danger: evasions are driven by their Q");
  dataset
      ->add_flag("--outcomes", options->outcomes,
                 "All drives by their Q to the end: what it comes to")
      ->needs("--by");
  add_threads(*dataset, options->threads, "They do not change what is made");
  dataset->add_flag("--json", options->as_json, "For programs");
  dataset->callback([options, &exit_code] { exit_code = make_dataset(*options); });
  add_danger_check(*command, exit_code);
  add_danger_coverage(*command, exit_code);
  add_danger_margins(*command, exit_code);
  add_danger_show(*command, exit_code);
}

}  // namespace saca::app
