#include "saca/eval/suite_source.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/core/suggestion.h"

namespace saca::eval {
namespace {

namespace fs = std::filesystem;

/// A suite of that name, or a family as a suite of itself.
Result<sim::Suite> find_suite(const fs::path& folder, const std::string& wanted,
                              const std::vector<std::string>& other_names) {
  const auto suites = sim::load_suites(folder / "suites.toml");
  if (!suites.has_value()) {
    return suites.error();
  }
  std::vector<std::string> names;
  for (const sim::Suite& suite : suites.value()) {
    if (suite.name == wanted) {
      return suite;
    }
    names.push_back(suite.name);
  }
  const bool is_plain = wanted.find('/') == std::string::npos && wanted != "surroundings";
  if (is_plain && !wanted.empty() && fs::is_regular_file(folder / (wanted + ".toml"))) {
    return sim::Suite{.name = wanted, .why = {}, .members = {{wanted, 1.0, {}}}};
  }
  names.insert(names.end(), other_names.begin(), other_names.end());
  const auto num_suites = static_cast<std::ptrdiff_t>(names.size());
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && name != "suites" && name != "surroundings") {
      names.push_back(name);
    }
  }
  std::sort(names.begin() + num_suites, names.end());
  return Error{Error::Code::out_of_range, fmt::format("{}: no suite or family is called so; {}",
                                                      wanted, suggestion(wanted, names))};
}

}  // namespace

Result<SuiteSource> SuiteSource::open(const SuiteDraw& draw) {
  const fs::path folder = draw.scenarios / "families";
  auto suite = find_suite(folder, draw.suite, draw.other_names);
  if (!suite.has_value()) {
    return suite.error();
  }
  const auto splits = sim::load_splits(draw.scenarios / "splits.toml");
  if (!splits.has_value()) {
    return splits.error();
  }
  SuiteSource source;
  source.car_ = draw.car;
  source.footprint_ = draw.footprint;
  source.suite_ = std::move(suite).value();
  for (const sim::Suite::Member& member : source.suite_.members) {
    auto family = sim::load_family(folder, member.family);
    if (!family.has_value()) {
      return family.error();
    }
    source.families_.push_back(std::move(family).value());
  }
  for (const sim::Family& family : source.families_) {  // last: a use of the test split is noted
    const auto seed = sim::seed_for(splits.value(), draw.split, family.name, draw.test_log);
    if (!seed.has_value()) {
      return seed.error();
    }
    source.seeds_.push_back(seed.value());
  }
  return source;
}

Result<sim::FamilySample> SuiteSource::sample(std::uint64_t number) const {
  const std::size_t member = sim::member_of(suite_, number);
  return sim::sample(families_[member], seeds_[member], number, car_, footprint_);
}

const std::string& SuiteSource::family_of(std::uint64_t number) const {
  return suite_.members[sim::member_of(suite_, number)].family;
}

}  // namespace saca::eval
