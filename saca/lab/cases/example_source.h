#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"
#include "saca/lab/cases/case_tools.h"
#include "saca/lab/cases/crash_case.h"
#include "saca/lab/cases/prompt_cases.h"
#include "saca/lab/families/family_cues.h"

namespace saca::cases {

/// What a file of cases gives examples of: it, and what is asked besides.
struct ExampleOptions {
  std::string file;
  std::string memory;  ///< a bank; empty: prompts tell of no case
  std::string car = "compact_rwd_ev";
  std::string cues;        ///< a suite whose cues the encounters have; empty: they have none
  std::uint64_t seed = 1;  ///< of the replies' words
};
/// All but the file, as a command has them.
[[nodiscard]] std::string example_text(const ExampleOptions& options);

/// A file of cases.
struct CaseFile {
  std::vector<CrashCase> cases;
  Fnv hash;  ///< of its text
};
/// @param file  JSON Lines, which gzip may have compressed
/// @return      as formats::read_compressed and crash_cases_from_text
[[nodiscard]] Result<CaseFile> read_cases(const std::string& file);

/// The cases that examples are made of, and what with.
struct ExampleSource {
  std::vector<CrashCase> cases;  ///< drawn from families that training may see
  int recorded = 0;              ///< left out: they cannot be drawn again
  int test_only = 0;             ///< left out: of a family that only the test split has
  CaseTools tools;
  std::optional<PromptCases> told;
  std::optional<families::FamilyCues>
      cues;                  ///< that the encounters have, with the law of what comes
  std::uint64_t digest = 0;  ///< of all that examples depend on, but for the options
};
/// @param tools      with atlas, cues and intent, of the options' car
/// @param scenarios  folder of the program's own: holds families/ and splits.toml
/// @return  an error that names the file, or says that nothing in it can be an example
[[nodiscard]] Result<ExampleSource> open_examples(CaseFile file, const ExampleOptions& options,
                                                  CaseTools tools,
                                                  const std::filesystem::path& scenarios);

}  // namespace saca::cases
