#pragma once

#include <string_view>

#include "saca/base/core/result.h"
#include "saca/runtime/tape_json.h"

namespace saca::runtime {

/// Strict: every line is as tape_text writes it, and the digest in the last one holds.
/// @param source  name for messages
/// @return        Error::Code::malformed, naming source, line, key, what was wanted, what came
[[nodiscard]] Result<TapeFile> read_tape(std::string_view text, std::string_view source);

}  // namespace saca::runtime
