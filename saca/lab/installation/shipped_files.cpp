#include "saca/lab/installation/shipped_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/suggestion.h"
#include "saca/runtime/tape_header.h"

namespace saca::installation {

namespace fs = std::filesystem;

namespace {

/// What is found by name, and how it is told.
struct ShippedFile {
  const char* what;
  const char* folder;                      ///< below the root
  std::array<std::string_view, 3> others;  ///< files of the folder that are something else
  const char* listed_by;  ///< the command that lists them; nullptr: the names are few
};

constexpr ShippedFile of_scenarios{"scenario", "scenarios", {"splits"}, "saca scenarios"};
constexpr ShippedFile of_families{
    "family", "scenarios/families", {"suites", "surroundings", "cues"}, nullptr};
constexpr ShippedFile of_cars{"car", "data/vehicles", {}, nullptr};
constexpr ShippedFile of_reach_cases{"case", "data/reach", {}, nullptr};

bool is_other(const ShippedFile& shipped, std::string_view name) {
  return std::find(shipped.others.begin(), shipped.others.end(), name) != shipped.others.end();
}

std::vector<fs::path> files_of(const Installation& here, const ShippedFile& shipped) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(here.root / shipped.folder)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && stem.find('.') == stem.npos &&
        !is_other(shipped, stem)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Error not_there(const Installation& here, const ShippedFile& shipped, const std::string& name) {
  std::vector<std::string> names;
  std::vector<std::string> begin_so;
  std::error_code problem;
  const bool is_there = fs::is_directory(here.root / shipped.folder, problem);
  for (const fs::path& file : is_there ? files_of(here, shipped) : std::vector<fs::path>()) {
    names.push_back(file.stem().string());
    if (names.back().starts_with(name)) {
      begin_so.push_back(names.back());
    }
  }
  const std::string typed = fs::path(name).stem().string();
  const std::string other =
      likely_meant(typed, names) || shipped.listed_by == nullptr ? suggestion(typed, names)
      : begin_so.empty() ? fmt::format("`{}` lists those that are shipped", shipped.listed_by)
                         : suggestion(typed, begin_so);
  return {Error::Code::unreadable,
          fmt::format("{}: no {} is there, neither a file nor the name of a shipped one; {}", name,
                      shipped.what, other)};
}

Result<fs::path> find_shipped(const Installation& here, const ShippedFile& shipped,
                              const std::string& name) {
  std::error_code problem;
  if (fs::exists(name, problem) && !fs::is_directory(name, problem)) {
    return fs::path(name);  // also what is no file, which its reader refuses
  }
  const bool plain = !fs::path(name).has_extension() && !fs::path(name).has_parent_path();
  const fs::path file = here.root / shipped.folder / (name + ".toml");
  if (plain && !name.empty() && !is_other(shipped, name) && fs::exists(file, problem)) {
    return file;
  }
  return not_there(here, shipped, name);
}

}  // namespace

Result<fs::path> find_scenario(const Installation& here, const std::string& name) {
  return find_shipped(here, of_scenarios, name);
}

Result<fs::path> find_reach_case(const Installation& here, const std::string& name) {
  return find_shipped(here, of_reach_cases, name);
}

Result<fs::path> find_car(const Installation& here, const std::string& name) {
  return find_shipped(here, of_cars, name);
}

Result<families::Family> read_family(const Installation& here, const std::string& name) {
  const auto file = find_shipped(here, of_families, name);
  return file.has_value()
             ? families::load_family(file.value().parent_path(), file.value().stem().string())
             : file.error();
}

std::vector<fs::path> shipped_scenarios(const Installation& here) {
  return files_of(here, of_scenarios);
}

Result<families::Splits> read_splits(const Installation& here) {
  return families::load_splits(here.root / "scenarios" / "splits.toml");
}

fs::path regulation_place(const Installation& here, const std::string& name) {
  return here.root / "data" / "protocols" / (name + ".toml");
}

Result<std::string> scenario_digest(const Installation& here, const std::string& scenario) {
  const auto file = find_scenario(here, scenario);
  if (!file.has_value()) {
    return file.error();
  }
  Fnv hash;
  if (auto problem = read_file(file.value(), [&](std::string_view bytes) { hash.add(bytes); })) {
    return *std::move(problem);
  }
  return runtime::digest_text(hash);
}

}  // namespace saca::installation
