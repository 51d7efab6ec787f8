#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/intention_scoring/evaluation.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_study/evaluation.h"
#include "saca/lab/intention_study/evaluation_json.h"
#include "saca/lab/intention_study/evaluation_text.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct EvalOptions {
  std::string sequences;
  std::string models;
  intention_study::Rivals rivals;
  std::string svg;
  std::uint64_t seed = 1;
  bool as_json = false;
};

/// The folder of weights: that of the shipped ones unless another was given.
Result<std::filesystem::path> models_of(const EvalOptions& options) {
  if (!options.models.empty()) {
    return std::filesystem::path(options.models);
  }
  const auto places = find_places();
  return places.has_value() ? Result(places.value().root / "models" / "intent") : places.error();
}

int evaluate(const EvalOptions& options) {
  const auto folder = models_of(options);
  if (!folder.has_value()) {
    return refused(folder.error());
  }
  const auto set = intention_scoring::read_sequences(options.sequences);
  if (!set.has_value()) {
    return refused(set.error());
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  const auto models = intention_scoring::read_models(folder.value());
  if (!models.has_value()) {
    return refused(models.error());
  }
  const auto evaluation = intention_study::evaluate(set.value(), models.value(), options.rivals,
                                                    options.seed, usual_threads());
  if (!evaluation.has_value()) {
    return refused(evaluation.error());
  }
  if (!options.svg.empty()) {
    const std::string picture = intention_study::confusion_svg(evaluation.value());
    if (const auto problem = long_work::write_output(options.svg, picture)) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print_json(intention_study::evaluation_json(evaluation.value()));
  } else {
    app::print("{}", intention_study::evaluation_text(evaluation.value()));
  }
  return success;
}

}  // namespace

void add_intent_eval(CLI::App& intent, int& exit_code) {
  CLI::App* const command = intent.add_subcommand(
      "eval", "Score models of intentions on what they have not seen, beside baselines");
  const auto options = std::make_shared<EvalOptions>();
  command->add_option("sequences", options->sequences, "HDF5 file of `saca intent examples`")
      ->required();
  command->add_option("--models", options->models,
                      "Folder of weights, one per part left out; default: the shipped ones");
  command->add_option("--plain-models", options->rivals.plain_models,
                      "Likewise, trained without the CRF and not calibrated, for comparison");
  command->add_option("--other-models", options->rivals.other_models,
                      "Folder of weights of another training, as they are, for comparison");
  command->add_option("--forecasts", options->rivals.forecasts,
                      "Forecasts of other models (saca.forecasts/1), for comparison");
  command->add_option("--svg", options->svg, "A picture of the confusion of recorded vehicles");
  command->add_option("--seed", options->seed, "Of the groups drawn for intervals")
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = evaluate(*options); });
}

}  // namespace saca::app
