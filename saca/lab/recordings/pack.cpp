#include "saca/lab/recordings/pack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "saca/base/core/csv.h"
#include "saca/base/core/file.h"
#include "saca/lab/recordings/commonroad.h"
#include "saca/lab/recordings/hundred_car_file.h"
#include "saca/lab/recordings/hundred_car_set.h"
#include "saca/lab/recordings/ngsim_csv.h"
#include "saca/lab/recordings/ngsim_set.h"
#include "saca/lab/recordings/recording_of_map.h"

namespace saca::recordings {
namespace {

namespace fs = std::filesystem;

/// A file's name in one line.
std::string shown_name(const fs::path& file) {
  std::string name = file.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, '?');
  return name;
}

void refuse(const Error& error, PackResult& packed) {
  ++packed.set.skipped["file or event: cannot be read"];
  packed.refused.push_back(error.message);
}

void keep(Recording recording, PackResult& packed) {
  if (recording.vehicles.empty()) {
    ++packed.set.skipped["file or event: no vehicle with enough samples"];
    return;
  }
  packed.set.recordings.push_back(std::move(recording));
}

void pack_map(const fs::path& path, PackResult& packed) {
  const Result<std::string> text = read_file(path, many_bytes);
  if (!text.has_value()) {
    refuse(text.error(), packed);
    return;
  }
  const Result<CommonRoad> file = read_commonroad(text.value(), path.string());
  if (!file.has_value() && is_set_based(text.value())) {
    ++packed.set.skipped["file: set-based predictions (SPOT), no recording"];
    return;
  }
  if (!file.has_value()) {
    refuse(file.error(), packed);
    return;
  }
  keep(recording_of_map(file.value(), shown_name(path), packed.set.skipped), packed);
}

/// Hands each file on; what there is then.
template <class PackFile>
Result<PackResult> pack_each(const std::vector<fs::path>& files, const PackProgress& progress,
                             const PackFile& pack_file) {
  PackResult packed;
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
  return packed;
}

void pack_event(const fs::path& path, std::string_view rows_text, const fs::path& table_path,
                std::string_view table, PackResult& packed) {
  const std::string_view field = trimmed(rows_text.substr(0, rows_text.find_first_of(",\r\n")));
  if (field.empty()) {  // an empty line
    return;
  }
  const std::string source = path.string() + ", event " + std::string(field.substr(0, 20));
  const std::optional<std::int64_t> event = hundred_car_number(rows_text);
  if (!event) {
    refuse({Error::Code::malformed, source + ": want a whole number in column 1"}, packed);
    return;
  }
  const auto told = read_hundred_car_event(table, table_path.string(), *event);
  const auto rows = read_hundred_car_rows(rows_text, source, *event);
  if (!told.has_value() || !rows.has_value()) {
    refuse(told.has_value() ? rows.error() : told.error(), packed);
    return;
  }
  keep(recording_of_event(rows.value(), told.value(), "event " + std::to_string(*event),
                          packed.set.skipped),
       packed);
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

Result<PackResult> pack_commonroad(const std::vector<fs::path>& files,
                                   const PackProgress& progress) {
  Result<PackResult> made = pack_each(files, progress, pack_map);
  if (!made.has_value()) {
    return made.error();
  }
  PackResult packed = std::move(made).value();
  name_groups(packed.set);
  packed.repeats = drop_repeats(packed.set);
  return packed;
}

Result<PackResult> pack_hundred_car(const std::vector<fs::path>& files,
                                    const PackProgress& progress) {
  const auto table = std::find_if(files.begin(), files.end(), [](const fs::path& path) {
    return path.filename() == hundred_car_table;
  });
  if (table == files.end()) {
    return Error{
        Error::Code::malformed,
        "want a table of events " + std::string(hundred_car_table) + " among the files, got none"};
  }
  const Result<std::string> text = read_file(*table, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  std::vector<fs::path> series;
  std::copy_if(files.begin(), files.end(), std::back_inserter(series), [](const fs::path& path) {
    return is_hundred_car_series(path.filename().string());
  });
  return pack_each(series, progress, [&](const fs::path& path, PackResult& packed) {
    const Result<std::string> bytes = read_file(path, many_bytes);
    if (!bytes.has_value()) {
      refuse(bytes.error(), packed);
      return;
    }
    for (std::string_view rest = bytes.value(); !rest.empty();) {
      pack_event(path, cut_hundred_car_event(rest), *table, text.value(), packed);
    }
  });
}

Result<PackResult> pack_ngsim(const std::vector<fs::path>& files, const PackProgress& progress) {
  NgsimTable table;
  for (std::size_t k = 0; k < files.size(); ++k) {
    NgsimReader reader(files[k].string(), table);
    if (const auto problem =
            read_file(files[k], [&](std::string_view bytes) { reader.take(bytes); })) {
      return *problem;
    }
    if (const auto problem = reader.finish()) {
      return *problem;
    }
    if (progress && !progress(k + 1, files.size())) {
      return Error{Error::Code::too_late, "stopped"};
    }
  }
  PackResult packed;
  packed.set = set_of_ngsim(table, files.size() == 1 ? shown_name(files[0]) : "files");
  if (packed.set.recordings.empty()) {
    return Error{Error::Code::malformed, "want recorded vehicles of freeways, got none in " +
                                             std::to_string(files.size()) + " files"};
  }
  return packed;
}

}  // namespace saca::recordings
