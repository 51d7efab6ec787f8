#include "apps/saca/options.h"
#include "saca/base/core/file.h"
#include "saca/lab/runs/replay_json.h"
#include "saca/lab/runs/replay_text.h"
#include "saca/lab/runs/tape_replay.h"
#include "saca/lab/vehicle_study/kept_atlas.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/runtime/read_tape.h"

namespace saca::app {
namespace {

struct ReplayOptions {
  std::string tape;
  std::string atlas;
  bool as_json = false;
};

ExitCode replay(const ReplayOptions& options) {
  const std::string text = need(read_file(options.tape, many_bytes));
  const auto tape = need(runtime::read_tape(text, options.tape));
  const auto inputs = installation::read_inputs(here(), tape.header.car);
  if (!inputs.has_value()) {
    refuse({inputs.error().code, options.tape + ": car: " + inputs.error().message});
  }
  const installation::Inputs& read = inputs.value();
  const auto replayed =
      need(runs::replayed(tape, options.tape,
                          {.car = &read.car,
                           .harm = &read.harm,
                           .intent = &read.intent,
                           .cues = &read.cues,
                           .program = SACA_VERSION,
                           .atlas = [&]() -> Result<atlas::Atlas> {
                             return options.atlas.empty()
                                        ? Result(vehicle_study::usual_atlas(here(), read))
                                        : atlas::read_atlas(options.atlas, read.car);
                           }}));
  app::print("{}", options.as_json ? runs::replay_json(tape, replayed).dump(1) + "\n"
                                   : runs::replay_text(tape, replayed));
  return replayed.first ? not_the_same : success;
}

}  // namespace

void add_replay(CLI::App& line) {
  const auto [command, options] = add_command<ReplayOptions>(
      line, "replay", "Work out again, bit by bit, what a run decided by, and compare", replay);
  add_needed(command, "tape", options.tape, "A file of `saca run --tape`");
  add(command, "--atlas", options.atlas,
      "The file of `saca atlas build` that was given to the run (default: the usual one)");
  add_json(command, options.as_json, "Print the result, for programs");
}

}  // namespace saca::app
