#include "apps/saca/shipped_cases.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/memory_commands.h"

namespace saca::app {

Result<std::vector<memory::Case>> shipped_cases(const Places& places,
                                                std::span<const memory::MadeWith> now) {
  auto read = read_cases((places.root / "data/memory/seed.jsonl.gz").string());
  if (!read.has_value()) {
    return read.error();
  }
  std::vector<memory::Case> cases = std::move(read).value();
  for (memory::Case& one : cases) {
    if (!memory::same_car_and_harm(one.made_with, now)) {
      one.trust = std::max(one.trust, memory::Trust::unchecked);
    }
  }
  return cases;
}

std::optional<Error> add_shipped_cases(memory::Store& memory, const Places& places,
                                       std::span<const memory::MadeWith> now) {
  const auto cases = shipped_cases(places, now);
  if (!cases.has_value()) {
    return cases.error();
  }
  const auto ids = memory.add_all(cases.value());
  return ids.has_value() ? std::nullopt : std::optional(ids.error());
}

}  // namespace saca::app
