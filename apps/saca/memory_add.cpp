#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/saca/inputs.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/moment_option.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/within.h"
#include "saca/base/core/printable.h"
#include "saca/lab/banks/bank_changes.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {
namespace {

struct AddOptions {
  std::string scenario;
  std::string file = "runs/memory.sqlite";
  std::string why;
  std::optional<manoeuvre::PolicyId> policy;
  std::optional<double> at;
};

int add_case(const AddOptions& options) {
  if (!is_utf8(options.why)) {
    return refused(
        Error{Error::Code::malformed, "--why: want UTF-8, got " + one_line(options.why)});
  }
  const auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto time = decision_time(inputs.value(), options.at);
  if (!time.has_value()) {
    return refused(time.error());
  }
  if (!time.value()) {
    return nothing_to_decide;
  }
  const scenario::Scenario& scenario = inputs.value().scenario;
  const memory::Case one =
      banks::expert_case(eval::scene_at(scenario, inputs.value().car, *time.value()),
                         {*options.policy, options.why, scenario.name});
  auto store = banks::open_to_add(options.file);
  if (!store.has_value()) {
    return refused(store.error());
  }
  memory::Store memory = std::move(store).value();
  const auto learnt = memory.learn(one);
  if (!learnt.has_value()) {
    return refused(learnt.error());
  }
  app::print("{}", banks::text_of(learnt.value(), memory.name()));
  return success;
}

}  // namespace

void add_memory_add(CLI::App& memory, int& exit_code) {
  CLI::App* const command =
      memory.add_subcommand("add", "Adds what somebody knows: this scenario wants that policy");
  const auto options = std::make_shared<AddOptions>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  add_policy(*command, options->policy, "What is best there: a number, 0 to 7, or a name")
      ->required();
  command->add_option("--why", options->why, "The reason, in a line");
  add_at(*command, options->at);
  command->add_option("--memory", options->file, "The memory bank")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = add_case(*options); });
}

}  // namespace saca::app
