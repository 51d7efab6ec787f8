#include <fmt/core.h>

#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_study/example_set.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

struct ExamplesOptions {
  intention_study::ExampleRequest request;
  std::string output;
};

int make_examples(const ExamplesOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto all = intention_study::example_set(options.request, usual_threads());
  if (!all.has_value()) {
    return refused(all.error());
  }
  if (const auto rule = intention_scoring::broken_rule(all.value())) {
    complain(fmt::format("{}: {}", options.request.sets.front(), *rule));
    return bad_input;
  }
  if (const auto problem = long_work::make_folder_of(options.output)) {
    return refused(*problem);
  }
  if (const auto problem = intention_scoring::write_sequences(options.output, all.value())) {
    return refused(*problem);
  }
  app::print("{}", intention_study::shares_text(all.value()));
  return success;
}

void add_examples(CLI::App& intent, int& exit_code) {
  CLI::App* const command = intent.add_subcommand(
      "examples", "Label recorded traffic, add simulated vehicles: what a model is trained with");
  const auto options = std::make_shared<ExamplesOptions>();
  command->add_option("sets", options->request.sets, "HDF5 files of `saca traffic pack`")
      ->required();
  command->add_option("-o,--output", options->output, "The sequences (HDF5)")->required();
  command->add_option("--parts", options->request.parts, "Into so many the recordings are split")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  command->add_option("--simulated", options->request.simulated, "Simulated vehicles to train with")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command->add_option("--seed", options->request.seed)->capture_default_str();
  command->callback([options, &exit_code] { exit_code = make_examples(*options); });
}

}  // namespace

void add_intent(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("intent", "What road users are about to do: examples, scores, pictures");
  command->require_subcommand(1);
  add_examples(*command, exit_code);
  add_intent_eval(*command, exit_code);
  add_intent_motion(*command, exit_code);
  add_intent_show(*command, exit_code);
}

}  // namespace saca::app
