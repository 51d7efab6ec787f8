#pragma once

#include <cstdint>
#include <string>

#include "saca/lab/cases/case_tools.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::cases {

// How an encounter of a record is played. Perception and chance are drawn by its name: which others
// are worked on does not matter.

/// Its number, by the record's name.
[[nodiscard]] std::uint64_t number_of_record(const std::string& name);

/// @param drawn  as its family or record has it
[[nodiscard]] scenario::Scenario case_world(const scenario::Scenario& drawn, std::uint64_t seed);
/// @param world   outlives the stage
/// @param name    of the record, or of its twin
[[nodiscard]] encounter::Stage case_stage(const scenario::Scenario& world, const CaseTools& tools,
                                          std::uint64_t seed, const std::string& name);

}  // namespace saca::cases
