#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/cases/example_source.h"
#include "saca/lab/cases/reply_example.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/progress.h"

namespace saca::cases {

/// How the rows of examples are worked out, and kept in between.
struct ExampleWork {
  std::string journal;  ///< its file
  std::string title;    ///< of the journal: program and command
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
  int threads = 1;
  std::uint64_t words = 1;  ///< seed of the replies' words
};

/// Of each case and its twin, from where the journal ends on.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<long_work::AllItems<ReplyExample>>> all_examples(
    const ExampleSource& source, const ExampleWork& work);

/// What there is in one set.
struct SetTally {
  int examples = 0;
  int twins = 0;
  int choosable = 0;  ///< more than one policy is admissible
  int tokens = 0;     ///< at most, without the system part
  std::map<std::string, int> families;
  std::map<std::string, int> choices;
};
/// Of all sets, the empty ones too.
using SetTallies = std::map<ExampleSet, SetTally>;
[[nodiscard]] SetTallies set_tallies(const std::vector<ReplyExample>& examples);

/// What every folder of sets tells of itself, in Markdown.
/// @param command  that makes it, without the program's name
[[nodiscard]] std::string data_card(const ExampleSource& source, const SetTallies& tallies,
                                    const std::string& command, std::string_view version);

/// Figures of `saca cases export --json` (docs/formats.md), but for who made them.
/// @param failed  cases that could not be played
[[nodiscard]] nlohmann::json sets_json(const ExampleSource& source, const SetTallies& tallies,
                                       std::size_t failed);

/// The same as a table.
/// @param folder  of the sets
[[nodiscard]] std::string sets_text(const ExampleSource& source, const SetTallies& tallies,
                                    const std::string& folder);

/// What a line of a set looks like (docs/formats.md).
enum class SetFormat : std::uint8_t {
  local,   ///< with what is known of each, for `training/`
  openai,  ///< as chat fine-tuning takes it
};
[[nodiscard]] std::optional<SetFormat> set_format_from(std::string_view name);

/// One file for each set, the prompts' fixed part, and the data card.
/// @param folder  is made where it is missing
/// @param system  language_model::system_part
/// @return        nullopt, else what could not be written
[[nodiscard]] std::optional<Error> write_sets(const std::filesystem::path& folder,
                                              const std::vector<ReplyExample>& examples,
                                              SetFormat format, const std::string& system,
                                              const std::string& card);

}  // namespace saca::cases
