#include "saca/lab/importers/hundred_car_release.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/lab/recordings/hundred_car_file.h"

namespace saca::importers {
namespace {

namespace fs = std::filesystem;

struct EventTable {
  fs::path path;
  std::string text;
};

/// The rows of one event on end.
struct EventRows {
  fs::path file;
  std::int64_t event = 0;
  std::string_view text;
};

HundredCarOutcome refused(const EventRows& part, std::string severity, const std::string& message) {
  return {part.event, std::move(severity),
          HundredCarRefusal{HundredCarReason::unreadable, message}};
}

HundredCarOutcome made_of(const EventRows& part, const EventTable& table,
                          HundredCarRequest request) {
  request.event = part.event;
  request.narrative.clear();
  const auto event =
      recordings::read_hundred_car_event(table.text, table.path.string(), part.event);
  if (!event.has_value()) {
    return refused(part, "", event.error().message);
  }
  const std::string& severity = event.value().severity;
  const std::string source = part.file.string() + ", event " + std::to_string(part.event);
  const auto rows = recordings::read_hundred_car_rows(part.text, source, part.event);
  if (!rows.has_value()) {
    return refused(part, severity, rows.error().message);
  }
  return {part.event, severity, judged_hundred_car(rows.value(), event.value(), request)};
}

/// What was made so far, by event, and of which rows.
class Outcomes {
 public:
  void take(const EventRows& part, const EventTable& table, const HundredCarRequest& request) {
    const std::size_t rows = std::hash<std::string_view>{}(part.text);
    const auto there = rows_.find(part.event);
    if (there == rows_.end()) {
      rows_.emplace(part.event, rows);
      made_.emplace(part.event, made_of(part, table, request));
    } else if (there->second != rows) {
      HundredCarOutcome& outcome = made_.at(part.event);
      outcome = refused(part, outcome.severity,
                        part.file.string() + ": event " + std::to_string(part.event) +
                            ": want its rows on end in one place, got others elsewhere");
    }
  }

  [[nodiscard]] std::vector<HundredCarOutcome> all() && {
    std::vector<HundredCarOutcome> outcomes;
    for (auto& [event, outcome] : made_) {
      outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  }

 private:
  std::map<std::int64_t, std::size_t> rows_;  ///< hashes of their text
  std::map<std::int64_t, HundredCarOutcome> made_;
};

}  // namespace

Result<std::vector<HundredCarOutcome>> import_hundred_cars(
    const fs::path& folder, const HundredCarRequest& request,
    const recordings::PackProgress& progress) {
  const auto found = recordings::files_in({folder}, ".txt");
  if (!found.has_value()) {
    return found.error();
  }
  const std::vector<fs::path>& files = found.value();
  const auto table_path = std::find_if(files.begin(), files.end(), [](const fs::path& path) {
    return path.filename() == recordings::hundred_car_table;
  });
  std::vector<fs::path> series;
  std::copy_if(files.begin(), files.end(), std::back_inserter(series), [](const fs::path& path) {
    return recordings::is_hundred_car_series(path.filename().string());
  });
  if (table_path == files.end()) {
    return Error{Error::Code::unreadable, folder.string() + ": want a table of events " +
                                              std::string(recordings::hundred_car_table) +
                                              " in or below it, got none"};
  }
  if (series.empty()) {
    return Error{Error::Code::malformed,
                 folder.string() + ": want series HundredCar_*.txt in or below it, got none"};
  }
  const Result<std::string> table_text = read_file(*table_path, many_bytes);
  if (!table_text.has_value()) {
    return table_text.error();
  }
  const EventTable table{*table_path, table_text.value()};
  Outcomes outcomes;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const Result<std::string> text = read_file(series[k], many_bytes);
    if (!text.has_value()) {
      return text.error();
    }
    for (std::string_view rest = text.value(); !rest.empty();) {
      const std::string_view rows = recordings::cut_hundred_car_event(rest);
      if (const auto event = recordings::hundred_car_number(rows)) {
        outcomes.take({series[k], *event, rows}, table, request);
      }
    }
    if (progress && !progress(k + 1, series.size())) {
      return Error{Error::Code::too_late, "stopped"};
    }
  }
  return std::move(outcomes).all();
}

std::size_t num_rebuilt(const std::vector<HundredCarOutcome>& outcomes) {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [](const HundredCarOutcome& one) { return one.rebuilt() != nullptr; }));
}

std::map<HundredCarReason, std::size_t> refusals(const std::vector<HundredCarOutcome>& outcomes) {
  std::map<HundredCarReason, std::size_t> counts;
  for (const HundredCarOutcome& outcome : outcomes) {
    if (const HundredCarRefusal* refusal = outcome.refusal()) {
      ++counts[refusal->reason];
    }
  }
  return counts;
}

}  // namespace saca::importers
