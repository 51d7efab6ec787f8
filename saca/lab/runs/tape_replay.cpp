#include "saca/lab/runs/tape_replay.h"

#include <utility>

#include "saca/base/core/clock.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/runtime/planes.h"
#include "saca/runtime/tape_header.h"

namespace saca::runs {

Result<runtime::Replay> replayed(const runtime::TapeFile& tape, const std::string& source,
                                 const ReplayMeans& means) {
  const runtime::TapeHeader& header = tape.header;
  SteadyClock clock;
  runtime::PlanesSetup setup{
      .forecast = {.car = means.car,
                   .harm = means.harm,
                   .cues = header.cues ? means.cues : nullptr},
      .thresholds = header.thresholds,
      .guard = header.guarded ? reflex::Guard::never_worse_than_braking : reflex::Guard::none,
      .forced = header.forced,
      .clock = &clock};
  const auto differs = [&](const runtime::TapeHeader& here) -> std::optional<Error> {
    const auto problem = mismatch(header, here);
    return problem ? std::optional(Error{problem->code, source + ": " + problem->message})
                   : std::nullopt;
  };
  runtime::TapeHeader here = runtime::tape_header(setup, *means.intent);
  here.program = means.program;
  here.atlas = header.atlas;  // it is opened, perhaps made, when all else is as it was
  if (const auto problem = differs(here)) {
    return *problem;
  }
  std::optional<atlas::Atlas> atlas;
  if (header.atlas) {
    auto opened = means.atlas();
    if (!opened.has_value()) {
      return opened.error();
    }
    atlas = std::move(opened).value();
    setup.forecast.atlas = &*atlas;
    here.atlas = runtime::tape_header(setup, *means.intent).atlas;
    if (const auto problem = differs(here)) {
      return *problem;
    }
  }
  return runtime::replay(tape.content, setup, *means.intent, header.num_draws);
}

}  // namespace saca::runs
