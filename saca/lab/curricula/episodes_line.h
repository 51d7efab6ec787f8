#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/curriculum_figures.h"

namespace saca::curricula {

/// The encounter of one number, of all seeds, as a line of a journal: an array of episodes. The
/// sizes of banks are not in it: they come of learning it again.
[[nodiscard]] std::string line_of(const eval::Episodes& episodes);

/// And back.
/// @param numbers  of the encounter of each seed
/// @return  Error::Code::malformed where it is no such line, of other seeds or of other encounters
[[nodiscard]] Result<eval::Episodes> episodes_from(const std::string& line,
                                                   const std::vector<std::uint64_t>& numbers);

}  // namespace saca::curricula
