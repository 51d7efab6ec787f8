#pragma once

#include <string>

#include "saca/lab/encounter/encounter.h"

namespace saca::encounter {

/// A run as JSON Lines, schema saca.trace/1 of docs/formats.md: what the run was, then one line for
/// each frame, then one for each event. Holds nothing of the clock: the same run, the same bytes.
[[nodiscard]] std::string trace_jsonl(const Setup& setup, const Record& record);

/// The same motions as CSV: one row for each body and frame.
[[nodiscard]] std::string trace_csv(const Setup& setup, const Record& record);

}  // namespace saca::encounter
