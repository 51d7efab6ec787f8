#include "apps/saca/shipped_cases.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "apps/saca/memory_commands.h"

namespace saca::app {
namespace {

/// Was the case worked out with this car, and with this harm?
bool is_of(const memory::Case& one, std::span<const memory::MadeWith> now) {
  return std::all_of(now.begin(), now.end(), [&one](const memory::MadeWith& input) {
    return (input.what != "car" && input.what != "harm") ||
           std::any_of(one.made_with.begin(), one.made_with.end(),
                       [&input](const memory::MadeWith& then) {
                         return then.what == input.what && then.digest == input.digest;
                       });
  });
}

}  // namespace

Result<std::vector<memory::Case>> shipped_cases(const Places& places,
                                                std::span<const memory::MadeWith> now) {
  auto read = read_cases((places.root / "data/memory/seed.jsonl.gz").string());
  if (!read.has_value()) {
    return read.error();
  }
  std::vector<memory::Case> cases = std::move(read).value();
  for (memory::Case& one : cases) {
    if (!is_of(one, now)) {
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
