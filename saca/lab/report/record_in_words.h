#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::report {

/// The answer to one question, in whole sentences.
struct Paragraph {
  std::string about;  ///< "What threatened"
  std::vector<std::string> sentences;
};

/// Why an encounter went as it did, in plain words. First in short: what was about to happen, what
/// was considered and rejected, why this was done; then what threatened, what was believed of whom,
/// what each plan was expected to end in, which were admissible, what was chosen and by which rule,
/// why not each of the others, what was switched, how it ended, what hindsight says.
///
/// Every number stands in the record, and is only rounded.
///
/// @param record  text of a record, schema saca.record/1: see docs/formats.md
/// @param source  name for messages
/// @return        Error::Code::malformed when it is not JSON, of another schema, or lacks a key
[[nodiscard]] Result<std::vector<Paragraph>> explanation(std::string_view record,
                                                         std::string_view source);

}  // namespace saca::report
