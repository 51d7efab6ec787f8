#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/lab/cases/example_source.h"
#include "saca/lab/cases/reply_score.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/progress.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::cases {

/// The first few of a set's cases, drawn by lot: by something that has nothing to do with what they
/// are, so that they stand for all. Files have them by state, year and number.
/// @param most  0: all of the set
/// @param file  that they were read from, for messages
/// @return      out_of_range: the set has none
[[nodiscard]] Result<std::vector<CrashCase>> cases_by_lot(std::vector<CrashCase> cases,
                                                          ExampleSet set, std::size_t most,
                                                          const std::string& file);

/// How replies are gathered, and kept in between.
struct ReplyWork {
  std::string journal;  ///< its file
  std::string title;    ///< of the journal: program and command
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
  std::uint64_t words = 1;  ///< seed of the expert's words
  /// true: replies are held to what is true while they are written
  /// (language_model::reply_grammar); false: anything may be written.
  bool constrained = true;
};

/// What a model replies about each case and its twin, without haste, from where the journal ends
/// on. A malformed reply is a problem of its case, as it is something that the model said.
/// @param clock  of the model
/// @return       nullopt: interrupted; the model's error where it cannot be asked any more
[[nodiscard]] Result<std::optional<long_work::AllItems<ExampleReply>>> model_replies(
    const ExampleSource& source, language_model::LanguageModel& model, const Clock& clock,
    const ReplyWork& work);

/// Their names, in this order.
[[nodiscard]] std::vector<std::string> records_of(const std::vector<CrashCase>& cases);

/// Sorts them as their cases stand in the file.
/// @param records  all names of records, in the file's order
void sort_as_in_file(std::vector<ExampleReply>& replies, const std::vector<std::string>& records);

/// A file of replies: schema saca.example_replies/2 (docs/formats.md).
[[nodiscard]] std::string replies_text(const std::vector<ExampleReply>& replies);

}  // namespace saca::cases
