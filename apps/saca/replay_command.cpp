#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/runtime/read_tape.h"
#include "saca/runtime/replay.h"

namespace saca::app {
namespace {

using nlohmann::json;

struct ReplayOptions {
  std::string tape;
  std::string atlas;
  bool as_json = false;
};

/// nullopt: it was recorded without.
Result<std::optional<atlas::Atlas>> open_atlas(const ReplayOptions& options,
                                               const runtime::TapeHeader& header,
                                               const Inputs& inputs) {
  if (!header.atlas) {
    return std::optional<atlas::Atlas>();
  }
  if (options.atlas.empty()) {
    return std::optional(usual_atlas(inputs));
  }
  auto atlas = atlas::read_atlas(options.atlas, inputs.car);
  return atlas.has_value() ? Result(std::optional(std::move(atlas).value())) : atlas.error();
}

json reproduced_json(const runtime::Reproduction& of) {
  return {{"recorded", of.recorded}, {"same", of.same}};
}

json replay_json(const runtime::TapeFile& tape, const runtime::Replay& replay) {
  json first;
  if (replay.first) {
    first = {{"scene", replay.first->scene},
             {"t_s", replay.first->time},
             {"what", replay.first->what},
             {"recorded", json::parse(replay.first->recorded)},
             {"got", json::parse(replay.first->got)}};
  }
  return {{"schema", "saca.replay/1"},
          {"scenario", tape.header.scenario},
          {"verdicts", reproduced_json(replay.verdicts)},
          {"decisions", reproduced_json(replay.decisions)},
          {"switches", reproduced_json(replay.switches)},
          {"answers", reproduced_json(replay.answers)},
          {"beliefs", reproduced_json(replay.beliefs)},
          {"verdicts_not_compared", replay.verdicts_not_compared},
          {"beliefs_not_compared", replay.beliefs_not_compared},
          {"steps_dropped", tape.content.dropped},
          {"steps_lost", tape.content.lost},
          {"first_difference", first}};
}

void print(const runtime::TapeFile& tape, const runtime::Replay& replay) {
  const runtime::TapeHeader& header = tape.header;
  app::print("Recorded{}{}: {} steps at pace {}, car {}, language model {}.\n",
             header.scenario.empty() ? "" : " in ", header.scenario, tape.content.steps.size(),
             name(header.pace), header.car, header.model);
  const auto row = [](const char* what, const runtime::Reproduction& of) {
    app::print("  {:<34} {:>6} of {:>6}\n", what, of.same, of.recorded);
  };
  app::print("Worked out again, the same to the last bit:\n");
  row("verdicts", replay.verdicts);
  row("choices at a trigger", replay.decisions);
  row("switches to another plan", replay.switches);
  row("answers of the reflex plane", replay.answers);
  row("scenes with what was believed", replay.beliefs);
  if (tape.content.dropped + tape.content.lost > 0) {
    app::print("The tape had no room for {} earlier and {} later steps.\n", tape.content.dropped,
               tape.content.lost);
  }
  if (replay.verdicts_not_compared + replay.beliefs_not_compared > 0) {
    app::print(
        "Not compared, because the tape does not have what they come from: {} verdicts, "
        "the beliefs of {} scenes.\n",
        replay.verdicts_not_compared, replay.beliefs_not_compared);
  }
  if (replay.first) {
    app::print("The first difference is at {} s, step {}: {} was {}, and is {} now.\n",
               replay.first->time, replay.first->scene, replay.first->what, replay.first->recorded,
               replay.first->got);
  }
}

int run(const ReplayOptions& options) {
  const auto text = read_file(options.tape, many_bytes);
  if (!text.has_value()) {
    return refused(text.error());
  }
  const auto tape = runtime::read_tape(text.value(), options.tape);
  if (!tape.has_value()) {
    return refused(tape.error());
  }
  const runtime::TapeHeader& header = tape.value().header;
  const auto inputs = read_inputs(header.car);
  if (!inputs.has_value()) {
    return refused({inputs.error().code, options.tape + ": car: " + inputs.error().message});
  }
  SteadyClock clock;
  runtime::PlanesSetup setup{
      .forecast = {.car = &inputs.value().car,
                   .harm = &inputs.value().harm,
                   .cues = header.cues ? &inputs.value().cues : nullptr},
      .thresholds = header.thresholds,
      .guard = header.guarded ? reflex::Guard::never_worse_than_braking : reflex::Guard::none,
      .forced = header.forced,
      .clock = &clock};
  runtime::TapeHeader here = runtime::tape_header(setup, inputs.value().intent);
  here.program = SACA_VERSION;
  here.atlas = header.atlas;  // it is opened, perhaps made, when all else is as it was
  auto problem = mismatch(header, here);
  const auto atlas = problem ? Result<std::optional<atlas::Atlas>>(*problem)
                             : open_atlas(options, header, inputs.value());
  if (!problem && atlas.has_value() && atlas.value()) {
    setup.forecast.atlas = &*atlas.value();
    here.atlas = runtime::tape_header(setup, inputs.value().intent).atlas;
    problem = mismatch(header, here);
  }
  if (problem) {
    return refused({problem->code, options.tape + ": " + problem->message});
  }
  if (!atlas.has_value()) {
    return refused(atlas.error());
  }
  const runtime::Replay replay =
      runtime::replay(tape.value().content, setup, inputs.value().intent, header.num_draws);
  if (options.as_json) {
    app::print("{}\n", replay_json(tape.value(), replay).dump(1));
  } else {
    print(tape.value(), replay);
  }
  return replay.first ? not_the_same : success;
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
