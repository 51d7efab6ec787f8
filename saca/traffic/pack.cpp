#include "saca/traffic/pack.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "saca/core/file.h"
#include "saca/traffic/commonroad.h"
#include "saca/traffic/recording_of_map.h"

namespace saca::traffic {
namespace {

namespace fs = std::filesystem;

/// A file's name in one line.
std::string shown_name(const fs::path& file) {
  std::string name = file.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, '?');
  return name;
}

void pack_file(const fs::path& path, Packed& packed) {
  const auto refuse = [&](const Error& error) {
    ++packed.set.skipped["file: cannot be read"];
    packed.refused.push_back(error.message);
  };
  const Result<std::string> text = read_file(path);
  if (!text.has_value()) {
    refuse(text.error());
    return;
  }
  const Result<CommonRoad> file = read_commonroad(text.value(), path.string());
  if (!file.has_value() && is_set_based(text.value())) {
    ++packed.set.skipped["file: set-based predictions (SPOT), no recording"];
    return;
  }
  if (!file.has_value()) {
    refuse(file.error());
    return;
  }
  Recording recording = recording_of_map(file.value(), shown_name(path), packed.set.skipped);
  if (recording.vehicles.empty()) {
    ++packed.set.skipped["file: no vehicle with enough samples"];
    return;
  }
  packed.set.recordings.push_back(std::move(recording));
}

}  // namespace

Result<std::vector<fs::path>> files_in(const std::vector<fs::path>& places,
                                       const std::string& ending) {
  std::vector<fs::path> files;
  for (const fs::path& place : places) {
    std::error_code problem;
    if (!fs::is_directory(place, problem)) {
      if (!fs::exists(place, problem)) {
        return Error{Error::Code::unreadable, place.string() + ": want a file or folder, got none"};
      }
      files.push_back(place);
      continue;
    }
    fs::recursive_directory_iterator found(place, problem);
    for (; !problem && found != fs::recursive_directory_iterator(); found.increment(problem)) {
      if (found->is_regular_file(problem) && found->path().extension() == ending) {
        files.push_back(found->path());
      }
    }
    if (problem) {
      return Error{Error::Code::unreadable, place.string() + ": " + problem.message()};
    }
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

Result<Packed> pack_commonroad(const std::vector<fs::path>& files, const PackProgress& progress) {
  Packed packed;
  for (std::size_t k = 0; k < files.size(); ++k) {
    pack_file(files[k], packed);
    if (progress && !progress(k + 1, files.size())) {
      return Error{Error::Code::too_late, "stopped"};
    }
  }
  if (packed.set.recordings.empty()) {
    return Error{Error::Code::malformed, packed.refused.empty()
                                             ? "want recorded vehicles, got none in " +
                                                   std::to_string(files.size()) + " files"
                                             : packed.refused.front()};
  }
  name_groups(packed.set);
  packed.repeats = drop_repeats(packed.set);
  return packed;
}

}  // namespace saca::traffic
