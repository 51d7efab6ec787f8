#include "saca/lab/curricula/bank_place.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace saca::curricula {

namespace fs = std::filesystem;

std::optional<Error> why_in_the_way(const fs::path& bank, const fs::path& folder) {
  std::error_code ignored;
  const fs::path its_place = fs::weakly_canonical(bank, ignored);
  const fs::path replaced = fs::weakly_canonical(folder, ignored);
  const bool inside =
      std::mismatch(replaced.begin(), replaced.end(), its_place.begin(), its_place.end()).first ==
      replaced.end();
  return inside ? std::optional(Error{
                      Error::Code::out_of_range,
                      fmt::format(
                          "--memory: want a bank outside of {}, whose banks are replaced, got {}",
                          folder.string(), bank.string())})
                : std::nullopt;
}

}  // namespace saca::curricula
