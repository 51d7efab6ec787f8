#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/danger_check.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/stopped.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/danger_study/margin_count.h"
#include "saca/lab/danger_study/margin_report.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct MarginOptions {
  std::string weights;
  std::string output;  ///< empty: the weights
  int situations = 400'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

int fit_margins(const MarginOptions& options) {
  long_work::watch_for_interrupt();
  const auto read = read_danger_weights(options.weights);
  if (!read.has_value()) {
    return refused(read.error());
  }
  const DangerWeights& weights = read.value();
  const std::string output = options.output.empty() ? options.weights : options.output;
  const std::string state = output + ".margins.json";
  if (const auto problem = long_work::why_outputs_unwritable({output, state})) {
    return refused(*problem);
  }
  const std::string of = danger_study::margin_count_of(weights.network, options.seed);
  const auto begun = danger_study::read_margin_count(state, of);
  if (!begun.has_value()) {
    return refused(begun.error());
  }
  const auto count = danger_study::counted_on(
      begun.value(), of, state, weights.inputs.car, weights.network,
      {options.situations, options.seed, options.threads, progress_display()});
  if (!count.has_value()) {
    return stopped(count.error());
  }
  const danger_study::MarginReport report = danger_study::margin_report(count.value());
  if (!options.as_json) {
    app::print("{}", danger_study::text_of(report));
  }
  if (const auto problem = write_file(
          output, formats::tensor_bytes(danger_study::with_margins(weights.tensors, report)))) {
    return refused(*problem);
  }
  std::filesystem::remove(state);
  if (options.as_json) {
    nlohmann::json all = danger_study::json_of(report);
    all.update({{"meta.weights", options.weights},
                {"meta.situations", report.situations},
                {"meta.seed", std::to_string(options.seed)}});
    print_json(all);
  }
  return success;
}

}  // namespace

void add_danger_margins(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<MarginOptions>();
  CLI::App* const command = danger.add_subcommand(
      "margins", "Fit what is added to learnt V_h, so that what it tells safe is hardly ever hit");
  command->add_option("WEIGHTS", options->weights, "safetensors file of saca-train-danger")
      ->required();
  command->add_option("--output", options->output, "The same weights with margins; else WEIGHTS");
  command->add_option("--situations", options->situations, "Driven where they are told safe")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  add_threads(*command, options->threads, "They do not change the margins");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = fit_margins(*options); });
}

}  // namespace saca::app
