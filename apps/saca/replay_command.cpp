#include <memory>
#include <string>
#include <utility>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/lab/runs/replay_json.h"
#include "saca/lab/runs/replay_text.h"
#include "saca/lab/runs/tape_replay.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/runtime/read_tape.h"

namespace saca::app {
namespace {

struct ReplayOptions {
  std::string tape;
  std::string atlas;
  bool as_json = false;
};

int run(const ReplayOptions& options) {
  const auto text = read_file(options.tape, many_bytes);
  if (!text.has_value()) {
    return refused(text.error());
  }
  const auto tape = runtime::read_tape(text.value(), options.tape);
  if (!tape.has_value()) {
    return refused(tape.error());
  }
  const auto inputs = read_inputs(tape.value().header.car);
  if (!inputs.has_value()) {
    return refused({inputs.error().code, options.tape + ": car: " + inputs.error().message});
  }
  const auto replay = runs::replayed(
      tape.value(), options.tape,
      {.car = &inputs.value().car,
       .harm = &inputs.value().harm,
       .intent = &inputs.value().intent,
       .cues = &inputs.value().cues,
       .program = SACA_VERSION,
       .atlas = [&]() -> Result<atlas::Atlas> {
         return options.atlas.empty() ? Result(usual_atlas(inputs.value()))
                                      : atlas::read_atlas(options.atlas, inputs.value().car);
       }});
  if (!replay.has_value()) {
    return refused(replay.error());
  }
  if (options.as_json) {
    app::print("{}\n", runs::replay_json(tape.value(), replay.value()).dump(1));
  } else {
    app::print("{}", runs::replay_text(tape.value(), replay.value()));
  }
  return replay.value().first ? not_the_same : success;
}

}  // namespace

void add_replay(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "replay", "Work out again, bit by bit, what a run decided by, and compare");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("tape", options->tape, "A file of `saca run --tape`")->required();
  command->add_option(
      "--atlas", options->atlas,
      "The file of `saca atlas build` that was given to the run (default: the usual "
      "one)");
  command->add_flag("--json", options->as_json, "Print the result, for programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
