#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"

namespace saca::banks {

/// The cases of a file of JSON Lines, as `saca memory export` and `build` write it, also compressed
/// by gzip (memory::cases_from_text).
/// @return  unreadable where it cannot be opened; malformed, naming the file, where it is damaged
[[nodiscard]] Result<std::vector<memory::Case>> read_cases(const std::string& file);

/// Those of several files, one after the other; an error names the first that cannot be read.
[[nodiscard]] Result<std::vector<memory::Case>> read_cases(const std::vector<std::string>& files);

/// The cases that are shipped (data/memory/seed.jsonl.gz): trusted by the car and the harm that
/// they were worked out with.
/// @param root  the folder that holds data/
[[nodiscard]] Result<std::vector<memory::Case>> shipped_cases(const std::filesystem::path& root);

/// The bank that cases are added to; one that is not there is made, with its folder.
[[nodiscard]] Result<memory::Store> open_to_add(const std::string& file);

/// An existing bank and all its cases, oldest first.
struct ReadBank {
  memory::Store store;
  std::vector<memory::Case> cases;
};
/// To look must not make one: unreadable where there is none.
[[nodiscard]] Result<ReadBank> read_bank(const std::string& file);

}  // namespace saca::banks
