#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/banks/case_tools.h"
#include "saca/lab/long_work/items_row.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/suites/played_encounter.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// Whether twins without risk give cases, too: a memory of accidents alone expects them.
enum class TwinCases { made, left_out };

/// What an encounter gives: a case, and one of its twin where there is one; none where the trigger
/// never fires (eval::case_at_trigger).
using EncounterCases = long_work::ItemsRow<memory::Case>;
[[nodiscard]] EncounterCases cases_of(const suites::PlayedEncounter& encounter,
                                      const CaseTools& tools, TwinCases twins);

/// Encounters that cases are made of.
struct CaseSource {
  suites::EncounterAt at;  ///< asked from several threads
  std::size_t count = 0;
  suites::PlayOptions play;
  TwinCases twins = TwinCases::made;
};

/// How long work on them is done (long_work::ResumableWork).
struct CaseWork {
  std::string journal;
  std::string title;     ///< of the journal: names everything on which the cases depend
  std::string progress;  ///< what is worked on
  int threads = 1;       ///< they do not change the cases
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// The cases of all encounters.
struct CaseBuild {
  std::size_t num_encounters = 0;
  std::vector<memory::Case> cases;    ///< with ids from 1 on, in the order of the encounters
  std::vector<std::string> problems;  ///< of encounters that could not be played
};

/// From where the journal ends on, with progress on the error stream.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<CaseBuild>> build_cases(const CaseSource& source,
                                                           const CaseTools& tools,
                                                           const CaseWork& work);

/// What `saca memory build --json` prints: how many cases of how many encounters, and of how many
/// each policy is the best ("memory.best.AEB").
/// @param command  that made them, without "saca"
/// @param version  of the program
[[nodiscard]] nlohmann::json json_of(const CaseBuild& build, const std::string& command,
                                     const std::string& version);

/// The same in a line.
/// @param file  that the cases were written to
[[nodiscard]] std::string text_of(const CaseBuild& build, const std::string& file);

}  // namespace saca::banks
