#pragma once

#include <string>

#include "saca/lab/encounter/record_check.h"
#include "saca/lab/installation/installation.h"

namespace saca::runs {

/// Holds a record against itself and against what it was made from, as that is here.
/// @param file  that `saca run` left
/// @return      malformed, naming the file, where it is no record, not whole, or older than
///              records that say by what they were made
[[nodiscard]] Result<encounter::RecordCheck> verified(const installation::Installation& here,
                                                      const std::string& file);

}  // namespace saca::runs
