#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/learning.h"
#include "saca/thinking/memory/store.h"

namespace saca::banks {

/// What an expert says of a scene.
struct ExpertWord {
  manoeuvre::PolicyId policy = manoeuvre::PolicyId::aeb;  ///< what is best there
  std::string why;                                        ///< the reason, in a line; may be empty
  std::string source;                                     ///< name of the scenario
};
/// As a case, unchecked: hearsay until a rollout confirms it.
[[nodiscard]] memory::Case expert_case(const world::Scene& scene, const ExpertWord& word);

/// What became of an expert's case, in a line.
/// @param bank  its name
[[nodiscard]] std::string text_of(const memory::LearningResult& learnt, const std::string& bank);

/// What tells cases apart: the same scene of the same source is the same case, whatever else is
/// said of it.
[[nodiscard]] std::string name_of_case(const memory::Case& one);

/// What of the trust that cases had elsewhere holds here.
enum class ImportedTrust {
  withdrawn,  ///< what was trusted is unchecked
  kept,       ///< they are one's own
};

/// What an import came to.
struct CaseImport {
  std::string bank;          ///< its name
  std::size_t taken = 0;     ///< cases taken over
  std::size_t left_out = 0;  ///< cases that were there already, or came twice
  ImportedTrust trust = ImportedTrust::withdrawn;
};
/// Takes over all cases that the bank does not have (name_of_case), or none; whoever imports at the
/// same time puts in none twice.
/// @return  what the bank could not do
[[nodiscard]] Result<CaseImport> import_cases(memory::Store& bank, std::vector<memory::Case> cases,
                                              ImportedTrust trust);
/// In a line.
[[nodiscard]] std::string text_of(const CaseImport& import);

/// What thinning a bank came to.
struct Thinning {
  std::string bank;           ///< its name
  std::size_t forgotten = 0;  ///< cases
  std::size_t left = 0;       ///< more than `most` where nothing else is stood for by another
  std::size_t most = 0;       ///< that were wanted
  std::size_t changed = 0;    ///< of those left: they stay since somebody learnt of them meanwhile
};
/// Forgets what is missed least (memory::most_redundant), until no more than `most` are left. What
/// is no longer as it was read stays.
/// @return  what the bank could not do
[[nodiscard]] Result<Thinning> thin(ReadBank& bank, std::size_t most);
/// In a line.
[[nodiscard]] std::string text_of(const Thinning& thinning);

}  // namespace saca::banks
