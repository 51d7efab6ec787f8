#include "saca/lab/curricula/start_digest.h"

#include <fmt/core.h>

#include "saca/base/core/fnv.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::curricula {

StartDigest digest_of(std::span<const memory::Case> start,
                      std::span<const memory::MadeWith> made_with) {
  Fnv hash;
  hash.add(memory::cases_text(start));
  StartDigest digest{.start = fmt::format("{} cases ({:016x})", start.size(), hash.value()),
                     .all = 0};
  for (const memory::MadeWith& one : made_with) {
    hash.add(one.digest);
  }
  digest.all = hash.value();
  return digest;
}

}  // namespace saca::curricula
