#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/importers/recorded_drive.h"

namespace saca::importers {

// What an event of the 100-Car study is held to, before and after it is rebuilt.

/// The message begins with the event's number.
[[nodiscard]] HundredCarRefusal refusal(const HundredCarRequest& request, HundredCarReason reason,
                                        const std::string& message);

/// What the study's words alone exclude.
[[nodiscard]] std::optional<HundredCarRefusal> excluded(const recordings::HundredCarEvent& event,
                                                        const HundredCarRequest& request);

/// What no car does and no radar sees, in words; empty when all is well. Bounds are ours: 100 m/s,
/// one turn a second, 1 km (rows that were read have no such targets).
[[nodiscard]] std::string impossible_value(const std::vector<recordings::HundredCarRow>& rows);

/// What keeps a scenario from being one that a file may hold, in words; empty when all is well.
[[nodiscard]] std::string scenario_problem(const scenario::Scenario& scenario);

/// How a scenario is not what the study says.
struct Contradiction {
  HundredCarRefusal refusal;
  std::optional<RecordedDeparture> departure;  ///< when that is what is wrong
};

/// The driver leaves the road, touches somebody in a near-crash, or nobody in a crash, each while
/// everybody concerned was recorded. The study's events with a departure are called so, and are no
/// rear-end conflicts.
[[nodiscard]] std::optional<Contradiction> contradiction(const scenario::Scenario& scenario,
                                                         const recordings::HundredCarEvent& event,
                                                         const HundredCarRequest& request);

}  // namespace saca::importers
