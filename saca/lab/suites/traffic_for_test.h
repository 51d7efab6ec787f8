#pragma once

// Recorded drives by hand, for the tests of this module.

#include <string>
#include <utility>
#include <vector>

#include "saca/lab/suites/traffic_watch.h"

namespace saca::suites {

/// One that cannot be opened again.
inline DriveToWatch made_drive(std::string source, std::string name) {
  return {.source = std::move(source),
          .name = std::move(name),
          .command = "saca import",
          .open = []() -> Result<RecordedEgo> {
            return Error{Error::Code::unreadable, "made by hand"};
          }};
}

/// Half an hour of "i80" over 20 km, in which the driver braked at one trigger and nothing was
/// needed at another, before which SACA acted; half an hour of "us101" over 30 km without an event;
/// and one drive of it that could not be watched.
inline WatchedTraffic made_traffic() {
  const ShadowTrigger braked{.time = 1.25,
                             .who = "car1",
                             .time_to_conflict = 1.29,
                             .speed = 15.0,
                             .judgement = {.driver_deceleration = 4.5,
                                           .needed_deceleration = 3.25,
                                           .least_gap = 0.5,
                                           .reason = eval::ShadowReason::driver_braked}};
  const ShadowTrigger needless{.time = 4.5,
                               .who = "van1",
                               .time_to_conflict = 0.5,
                               .speed = 3.0,
                               .judgement = {.needed_deceleration = std::nullopt}};
  WatchedTraffic traffic;
  traffic.drives = {made_drive("i80", "a"), made_drive("us101", "b"), made_drive("us101", "c")};
  traffic.rows = {{.source = "i80",
                   .drive = "a",
                   .left_out = {},
                   .watched = {.seconds = 1800.0,
                               .metres = 20'000.0,
                               .previews = {{0.5, 1.5, "car1"}},
                               .triggers = {braked, needless},
                               .interventions = {{needless, "AEB", true}}}},
                  {.source = "us101",
                   .drive = "b",
                   .left_out = {},
                   .watched = {.seconds = 1800.0, .metres = 30'000.0}},
                  {.source = "us101", .drive = "c", .left_out = "no lane", .watched = {}}};
  traffic.found = 12;
  traffic.notes = {"CommonRoad: 4 tracks of other than cars are no egos"};
  return traffic;
}

}  // namespace saca::suites
