#include "apps/saca/shipped_cases.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

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

Result<memory::Store> open_or_begin(const std::string& file, const Places& places,
                                    std::span<const memory::MadeWith> now) {
  std::error_code problem;
  const bool is_there = std::filesystem::exists(file, problem);
  auto opened = memory::Store::open(file);
  if (!opened.has_value() || is_there) {
    return opened;
  }
  memory::Store store = std::move(opened).value();
  const auto cases = shipped_cases(places, now);
  if (!cases.has_value()) {
    return cases.error();
  }
  const auto ids = store.add_all(cases.value());
  if (!ids.has_value()) {
    return ids.error();
  }
  return store;
}

}  // namespace saca::app
