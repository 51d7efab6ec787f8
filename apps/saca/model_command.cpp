#include <memory>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/model_trials/model_info.h"

namespace saca::app {
namespace {

int model_info(bool as_json) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  SteadyClock clock;
  const auto model = open_local_model(places.value(), runtime::Pace::real, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const auto info = model.value()->info(clock.now() + std::chrono::seconds(30));
  if (!info.has_value()) {
    return unanswered(info.error());
  }
  const nlohmann::json out = model_trials::model_info(info.value(), model.value()->figures());
  if (as_json) {
    app::print_json(model_trials::model_info_json(out));
  } else {
    app::print("{}", model_trials::model_info_text(out));
  }
  return success;
}

}  // namespace

void add_model(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("model", "The local language model");
  command->require_subcommand(1);
  CLI::App* const info =
      command->add_subcommand("info", "Which it is, its size, how fast it loads");
  const auto as_json = std::make_shared<bool>(false);
  info->add_flag("--json", *as_json, "For programs");
  info->callback([as_json, &exit_code] { exit_code = model_info(*as_json); });
  add_model_bench(*command, exit_code);
  add_model_score(*command, exit_code);
}

}  // namespace saca::app
