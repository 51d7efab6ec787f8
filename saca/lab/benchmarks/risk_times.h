#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/base/world/footprint.h"
#include "saca/lab/benchmarks/note.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/thinking/danger/danger.h"

namespace saca::benchmarks {

/// What is asked about: who meets, and how often the times are taken.
struct RiskTask {
  world::Footprint ego, other;
  std::size_t num_meetings = std::size_t{1} << 16;
  std::size_t num_samples = 20'000;      ///< of meetings that a table has
  std::size_t num_beyond_samples = 200;  ///< of others
};

/// A car's danger with two tables, beside a body at rest and at 5 m/s, as large as those of
/// `saca run`; solved to 0.5 s only, which the time of a look-up does not depend on.
/// @return  an error where the car is beyond what a table may hold
[[nodiscard]] Result<danger::DangerModel> model_of_two_tables(const manoeuvre::Car& car,
                                                              const world::Footprint& other,
                                                              const Note& note);

/// Of a danger: reach.risk_us where a table has the meeting, reach.risk_beyond_us where evasions
/// are driven, and reach.risk_us.exact_share, of all that were drawn.
/// @param model  has a table of some of the meetings, and not of all
[[nodiscard]] nlohmann::json risk_times(const danger::DangerModel& model, const RiskTask& task,
                                        const Clock& clock, const Note& note);

}  // namespace saca::benchmarks
