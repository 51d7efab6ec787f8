#include "apps/saca/places.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "apps/saca/settings.h"
#include "saca/base/core/printable.h"
#include "saca/base/core/suggestion.h"

namespace saca::app {

namespace fs = std::filesystem;

Result<Places> find_places() {
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  if (problem) {
    return Error{Error::Code::unreadable, "/proc/self/exe: " + problem.message()};
  }
  const fs::path folder = program.parent_path();
  for (const fs::path& root : {folder / "../share/saca", folder / "../.."}) {
    if (fs::exists(root / "data" / "harm.toml", problem)) {
      return Places{.root = fs::weakly_canonical(root, problem),
                    .model_host = folder / "saca-model-host"};
    }
  }
  return Error{Error::Code::unreadable,
               "data/harm.toml is neither beside the program's build folder nor in share/saca"};
}

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

std::vector<fs::path> files_of(const Places& places, const ShippedFile& shipped) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(places.root / shipped.folder)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && stem.find('.') == stem.npos &&
        !is_other(shipped, stem)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Error not_there(const Places& places, const ShippedFile& shipped, const std::string& name) {
  std::vector<std::string> names;
  std::vector<std::string> begin_so;
  for (const fs::path& file : files_of(places, shipped)) {
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

Result<fs::path> find_shipped(const Places& places, const ShippedFile& shipped,
                              const std::string& name) {
  std::error_code problem;
  if (fs::exists(name, problem) && !fs::is_directory(name, problem)) {
    return fs::path(name);  // also what is no file, which its reader refuses
  }
  const bool plain = !fs::path(name).has_extension() && !fs::path(name).has_parent_path();
  const fs::path file = places.root / shipped.folder / (name + ".toml");
  if (plain && !name.empty() && !is_other(shipped, name) && fs::exists(file, problem)) {
    return file;
  }
  return not_there(places, shipped, name);
}

}  // namespace

Result<fs::path> find_scenario(const Places& places, const std::string& name) {
  return find_shipped(places, of_scenarios, name);
}

Result<fs::path> find_reach_case(const Places& places, const std::string& name) {
  return find_shipped(places, of_reach_cases, name);
}

Result<fs::path> find_car(const Places& places, const std::string& name) {
  return find_shipped(places, of_cars, name);
}

Result<fs::path> find_family(const Places& places, const std::string& name) {
  return find_shipped(places, of_families, name);
}

std::vector<fs::path> shipped_scenarios(const Places& places) {
  return files_of(places, of_scenarios);
}

namespace {

/// Where what takes long to make is kept.
fs::path kept_place(const Places& places, const fs::path& file) {
  std::error_code problem;
  if (fs::exists(places.root / file, problem)) {
    return places.root / file;
  }
  if (!settings().cache.empty()) {
    return fs::path(settings().cache) / file;
  }
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != 0) {
    return fs::path(cache) / "saca" / file;
  }
  const char* const home = std::getenv("HOME");
  return (home == nullptr ? places.root : fs::path(home) / ".cache" / "saca") / file;
}

}  // namespace

fs::path atlas_place(const Places& places, const std::string& car) {
  return kept_place(places, fs::path("atlases") / (car + ".atlas"));
}

fs::path danger_place(const Places& places, const std::string& car, const std::string& table) {
  return kept_place(places, fs::path("reach") / car / (table + ".h5"));
}

bool is_png_or_html(const std::string& output) {
  const fs::path extension = fs::path(output).extension();
  if (extension == ".png" || extension == ".html") {
    return true;
  }
  complain(fmt::format("--output: want a name that ends in .png or .html, got '{}'", output));
  return false;
}

void complain(const std::string& message) {
  constexpr std::size_t longest_complaint = 8'000;  // characters; a path has up to 4096
  std::fputs(fmt::format("saca: {}\n", one_line(message, longest_complaint)).c_str(),
             stderr);  // which may be closed
}

void complain_of(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    complain(message);
  }
}

int refused(const Error& problem) {
  complain(problem.message);
  return problem.code == Error::Code::unwritable ? cannot_write : bad_input;
}

int unanswered(const Error& problem) {
  const int code = refused(problem);
  return problem.code == Error::Code::too_late ? static_cast<int>(too_slow) : code;
}

}  // namespace saca::app
