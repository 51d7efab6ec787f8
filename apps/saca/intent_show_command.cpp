#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/intention_scoring/predict.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_study/sample_page.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/intention_chart.h"
#include "saca/lab/report/intention_page.h"

namespace saca::app {
namespace {

struct ShowOptions {
  intention_study::SampleRequest request;
  std::string output;
  std::string model;
};

int show(const ShowOptions& options) {
  const auto set = intention_scoring::read_sequences(options.request.source);
  if (!set.has_value()) {
    return refused(set.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto chosen = intention_study::drawn_samples(set.value(), options.request);
  if (chosen.empty()) {
    complain(fmt::format("{}: want sequences that fit --split and --name, got none",
                         options.request.source));
    return bad_input;
  }
  std::vector<intention_scoring::Forecasts> forecasts;
  if (!options.model.empty()) {
    const auto model = intent::read_model(options.model);
    if (!model.has_value()) {
      return refused(model.error());
    }
    forecasts = intention_scoring::predicted(
        model.value(), intention_study::sequences_of(set.value(), chosen), usual_threads());
  }
  const auto page = intention_study::sample_page(set.value(), options.request, chosen, forecasts);
  const bool as_svg = std::filesystem::path(options.output).extension() == ".svg";
  const std::string text =
      as_svg ? report::intention_sample_svg(page.samples.front()) : report::intention_page(page);
  if (const auto problem = long_work::write_output(options.output, text)) {
    return refused(*problem);
  }
  app::print("{}: {} samples\n", options.output, as_svg ? 1 : page.samples.size());
  return success;
}

}  // namespace

void add_intent_show(CLI::App& intent, int& exit_code) {
  CLI::App* const command =
      intent.add_subcommand("show", "Draw sequences with their labels, and what a model believes");
  const auto options = std::make_shared<ShowOptions>();
  command->add_option("sequences", options->request.source, "HDF5 file of `saca intent examples`")
      ->required();
  command->add_option("-o,--output", options->output, "A page (.html), or its first sample (.svg)")
      ->required();
  command->add_option("--model", options->model, "Weights whose beliefs are shown");
  command->add_option("--split", options->request.split,
                      "Only of this one; default: what was recorded");
  command->add_option("--name", options->request.name, "Only the sequence of this name");
  command
      ->add_option("--samples", options->request.samples, "How many are drawn; each class in turn")
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  command->add_option("--seed", options->request.seed)->capture_default_str();
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace saca::app
