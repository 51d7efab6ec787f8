#include "apps/saca/shipped_cases.h"

#include "apps/saca/memory_commands.h"

namespace saca::app {

Result<std::vector<memory::Case>> shipped_cases(const Places& places) {
  return read_cases((places.root / "data/memory/seed.jsonl.gz").string());
}

}  // namespace saca::app
