#pragma once

// A run by hand, for the tests of this module.

#include <utility>

#include "saca/base/core/units.h"
#include "saca/lab/regulation/regulation_run.h"

namespace saca::regulation {

/// Two cars, "small" and "large"; "nothing" and "aeb"; four cells: a car stands ahead, at 36 and at
/// 72 km/h, and nobody may be touched; somebody stands there, at 36 km/h, the driver brakes too and
/// may hit with 9 km/h; a plate lies there, at 36 km/h.
///
/// AEB fails with the small car at 72 km/h, by 8 m/s, and with the large one at 36 and 72 km/h, by
/// 3 and by 12 m/s; the large one hits who stands with 2 m/s, which is allowed. "nothing" threw
/// with the small car and the plate.
inline RegulationRun some_run() {
  using eval::LimitKind;
  using eval::TestKind;
  using eval::TestVerdict;
  eval::Regulation text;
  text.name = "r1";
  text.title = "Some text";
  text.source = "where it stands";
  text.surfaces = {{.name = "dry", .grip = 0.9, .source = "6.1"},
                   {.name = "wet", .grip = 0.5, .source = "6.2"}};
  text.least_braking = 3.0;
  text.least_braking_source = "5.1";
  text.notes = {"Nothing is left out."};
  text.rows = {{.name = "standing_car",
                .title = "A car stands",
                .kind = TestKind::stopped_lead,
                .paragraph = "7.1",
                .speeds = {10.0, 20.0},
                .limit = LimitKind::no_contact},
               {.name = "standing_person",
                .title = "Somebody stands",
                .kind = TestKind::standing,
                .paragraph = "7.2",
                .speeds = {10.0},
                .manual_braking = true,
                .limit = LimitKind::impact_speed,
                .impact_speeds = {2.5}},
               {.name = "plate",
                .title = "A plate lies",
                .kind = TestKind::steel_plate,
                .paragraph = "7.3",
                .speeds = {10.0},
                .limit = LimitKind::deceleration,
                .peak_deceleration = from_g(0.25)}};
  RegulationRun run = tests_of(std::move(text), {"small", "large"}, {"nothing", "aeb"});
  const auto at = [&](std::size_t car, std::size_t cell, std::size_t method) -> RegulationResult& {
    return run.results[(car * run.cells.size() + cell) * run.methods.size() + method];
  };
  at(0, 1, 1).judged = {.verdict = TestVerdict::contact, .impact_speed = 8.0};
  at(1, 0, 1).judged = {.verdict = TestVerdict::contact, .impact_speed = 3.0};
  at(1, 1, 1).judged = {.verdict = TestVerdict::contact, .impact_speed = 12.0};
  at(1, 2, 1).judged.impact_speed = 2.0;
  at(1, 3, 1).judged.peak_deceleration = from_g(0.2);
  at(0, 3, 0).judged.verdict = TestVerdict::fault;
  at(0, 3, 0).fault = "it threw";
  run.meta = {{"meta.command", "saca suite r1"}};
  return run;
}

/// The run of "aeb" alone on the second surface: all is passed, but for the large car at 72 km/h.
inline RegulationRun on_the_second_surface() {
  RegulationRun run = tests_of(some_run().regulation, {"small", "large"}, {"aeb"});
  run.regulation.surface = 1;
  run.results[run.cells.size() + 1].judged = {.verdict = eval::TestVerdict::contact,
                                              .impact_speed = 15.0};
  return run;
}

}  // namespace saca::regulation
