#include <memory>
#include <string>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/intention_study/motion_study.h"
#include "saca/lab/recordings/set_file.h"

namespace saca::app {
namespace {

struct MotionOptions {
  std::vector<std::string> sets;
  bool as_json = false;
};

int fit_motion(const MotionOptions& options) {
  intention_study::MotionStudy study;
  for (const std::string& file : options.sets) {
    const auto set = recordings::read_set(file);
    if (!set.has_value()) {
      return refused(set.error());
    }
    study.add(set.value());
  }
  const auto sites = study.sites();
  if (options.as_json) {
    app::print_json(intention_study::motion_json(sites));
  } else {
    app::print("{}", intention_study::motion_text(sites));
  }
  return success;
}

}  // namespace

void add_intent_motion(CLI::App& intent, int& exit_code) {
  CLI::App* const command =
      intent.add_subcommand("motion", "Measure how people really brake and change lanes");
  const auto options = std::make_shared<MotionOptions>();
  command->add_option("sets", options->sets, "HDF5 files of `saca traffic pack`")->required();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = fit_motion(*options); });
}

}  // namespace saca::app
