#include "saca/lab/eval/suite_source.h"

#include <fmt/core.h>

#include <algorithm>

#include "saca/base/core/suggestion.h"

namespace saca::eval {
namespace {

namespace fs = std::filesystem;

/// Files beside the families that are none.
bool is_shared(std::string_view name) {
  return name == "surroundings" || name == "cues";
}

/// A suite of that name, or a family as a suite of itself.
Result<families::Suite> find_suite(const fs::path& folder, const std::string& wanted,
                                   const std::vector<std::string>& other_names) {
  const auto suites = families::load_suites(folder / "suites.toml");
  if (!suites.has_value()) {
    return suites.error();
  }
  std::vector<std::string> names;
  for (const families::Suite& suite : suites.value()) {
    if (suite.name == wanted) {
      return suite;
    }
    names.push_back(suite.name);
  }
  const bool is_plain = wanted.find('/') == std::string::npos && !is_shared(wanted);
  if (is_plain && !wanted.empty() && fs::is_regular_file(folder / (wanted + ".toml"))) {
    return families::Suite{.name = wanted, .why = {}, .members = {{wanted, 1.0, {}}}};
  }
  names.insert(names.end(), other_names.begin(), other_names.end());
  const auto num_suites = static_cast<std::ptrdiff_t>(names.size());
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && name != "suites" && !is_shared(name)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin() + num_suites, names.end());
  return Error{Error::Code::out_of_range, fmt::format("{}: no suite or family is called so; {}",
                                                      wanted, suggestion(wanted, names))};
}

Result<std::optional<families::FamilyCues>> cues_of(const fs::path& folder,
                                                    const families::Suite& suite) {
  if (suite.cues.empty()) {
    return std::optional<families::FamilyCues>();
  }
  const auto law = intent::load_cue_law(folder / "cues.toml");
  if (!law.has_value()) {
    return law.error();
  }
  return std::optional(families::FamilyCues{law.value(), suite.cues});
}

}  // namespace

Result<families::FamilyCues> cues_of_suite(const fs::path& families, const std::string& suite) {
  const auto found = find_suite(families, suite, {});
  if (!found.has_value()) {
    return found.error();
  }
  const auto cues = cues_of(families, found.value());
  if (!cues.has_value()) {
    return cues.error();
  }
  return cues.value() ? Result(*cues.value())
                      : Error{Error::Code::out_of_range,
                              suite + ": want a suite with cues, got one without"};
}

Result<SuiteSource> SuiteSource::open(const SuiteDraw& draw) {
  const fs::path folder = draw.scenarios / "families";
  auto suite = find_suite(folder, draw.suite, draw.other_names);
  if (!suite.has_value()) {
    return suite.error();
  }
  const auto splits = families::load_splits(draw.scenarios / "splits.toml");
  if (!splits.has_value()) {
    return splits.error();
  }
  SuiteSource source;
  source.car_ = draw.car;
  source.footprint_ = draw.footprint;
  source.suite_ = std::move(suite).value();
  for (const families::Suite::Member& member : source.suite_.members) {
    auto family = families::load_family(folder, member.family);
    if (!family.has_value()) {
      return family.error();
    }
    source.families_.push_back(std::move(family).value());
  }
  const auto cues = cues_of(folder, source.suite_);
  if (!cues.has_value()) {
    return cues.error();
  }
  for (families::Family& family : source.families_) {
    family.cues = cues.value();
  }
  for (const families::Family& family :
       source.families_) {  // last: a use of the test split is noted
    const auto seed = families::seed_for(splits.value(), draw.split, family.name, draw.test_log);
    if (!seed.has_value()) {
      return seed.error();
    }
    source.seeds_.push_back(seed.value());
  }
  return source;
}

Result<families::FamilySample> SuiteSource::sample(std::uint64_t number) const {
  const std::size_t member = families::member_of(suite_, number);
  return families::sample(families_[member], seeds_[member], number, car_, footprint_);
}

const std::string& SuiteSource::family_of(std::uint64_t number) const {
  return suite_.members[families::member_of(suite_, number)].family;
}

}  // namespace saca::eval
