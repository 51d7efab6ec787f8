#include "saca/lab/crash_records/fars.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

#include "saca/base/core/csv.h"
#include "saca/base/core/file.h"
#include "saca/lab/crash_records/csv_columns.h"

namespace saca::crash_records {
namespace {

namespace fs = std::filesystem;
using Crashes = std::map<CrashId, FarsCrash>;

/// A coded column, and which of its codes say that nothing is known. Source: the manual.
template <class Row>
struct CodedColumn {
  std::string_view name;
  Code Row::*field;
  int unknown_from;              ///< this and all above
  bool zero_is_unknown = false;  ///< 0: no trafficway, no driver, no limit
};

constexpr std::array<CodedColumn<FarsCrash>, 3> crash_columns{{
    {"LGT_COND", &FarsCrash::light, 8},
    {"RELJCT2", &FarsCrash::junction, 98},
    {"TYP_INT", &FarsCrash::intersection, 98},
}};

// TRAV_SP has 997 for more than 151 mph; VSPD_LIM 98 and 99; VNUM_LAN 8 and 9 after "seven or
// more".
constexpr std::array<CodedColumn<FarsVehicle>, 12> vehicle_columns{{
    {"BODY_TYP", &FarsVehicle::body, 98},
    {"TRAV_SP", &FarsVehicle::travel_speed, 997},
    {"VSPD_LIM", &FarsVehicle::speed_limit, 98, true},
    {"VTRAFWAY", &FarsVehicle::trafficway, 8, true},
    {"VNUM_LAN", &FarsVehicle::lanes, 8, true},
    {"VALIGN", &FarsVehicle::alignment, 8, true},
    {"VSURCOND", &FarsVehicle::surface, 98, true},
    {"P_CRASH1", &FarsVehicle::manoeuvre, 99, true},
    {"P_CRASH2", &FarsVehicle::event, 99},
    {"P_CRASH3", &FarsVehicle::avoidance, 98, true},
    {"ACC_TYPE", &FarsVehicle::crash_type, 99, true},
    {"IMPACT1", &FarsVehicle::impact, 98, true},
}};

constexpr std::array<CodedColumn<FarsPerson>, 4> person_columns{{
    {"PER_TYP", &FarsPerson::type, 88},
    {"AGE", &FarsPerson::age, 998},
    {"STR_VEH", &FarsPerson::struck_by, 1000, true},
    {"LOCATION", &FarsPerson::location, 98, true},
}};

/// A whole number that may be written with decimals ("7.0").
std::optional<int> whole(const std::string& field) {
  constexpr double most = 1e9;
  const auto value = finite_number(field);
  if (!value || *value != std::floor(*value) || *value < 0.0 || *value > most) {
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

/// Reads the coded columns of a row, which begin at `first`.
template <class Row, std::size_t count>
std::optional<std::string> read_codes(const CsvRow& from, std::size_t first,
                                      const std::array<CodedColumn<Row>, count>& columns, Row& to) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& field = from.fields[first + i];
    const CodedColumn<Row>& column = columns[i];
    if (field.empty() || field == ".") {
      continue;
    }
    const auto code = whole(field);
    if (!code) {
      return fmt::format("column {}: want a code, got `{}`", column.name, field.substr(0, 20));
    }
    if (*code < column.unknown_from && !(*code == 0 && column.zero_is_unknown)) {
      to.*(column.field) = *code;
    }
  }
  return std::nullopt;
}

template <class Row, std::size_t count>
std::vector<CsvColumn> with_codes(std::vector<CsvColumn> keys,
                                  const std::array<CodedColumn<Row>, count>& columns) {
  for (const CodedColumn<Row>& column : columns) {
    keys.push_back({column.name});
  }
  return keys;
}

/// The file of a folder with that name, in any case.
Result<fs::path> file_in(const fs::path& folder, std::string_view name) {
  std::error_code problem;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (boost::algorithm::iequals(entry.path().filename().string(), name)) {
      found.push_back(entry.path());
    }
  }
  if (problem) {
    return Error{Error::Code::unreadable, folder.string() + ": " + problem.message()};
  }
  if (found.size() != 1) {
    return Error{Error::Code::unreadable,
                 fmt::format("{}: want one file {}, got {}; a release of FARS has accident.csv, "
                             "vehicle.csv and person.csv",
                             folder.string(), name, found.size())};
  }
  return found.front();
}

/// Which crash a row is of; the year is in it, or the same for all.
struct Keys {
  std::optional<int> year;  ///< of the whole release

  [[nodiscard]] std::optional<std::string> read(const CsvRow& row, CrashId& id) const {
    const auto number = whole(row.fields[0]);
    constexpr int least = 10'001;  // the first case of the first state
    if (!number || *number < least) {
      return fmt::format("column ST_CASE: want a state's code and a case's number, got `{}`",
                         row.fields[0].substr(0, 20));
    }
    const auto its_year = row.fields[1].empty() ? year : whole(row.fields[1]);
    if (!its_year) {
      return row.fields[1].empty()
                 ? std::string("column YEAR: want it here or one year in accident.csv, got neither")
                 : fmt::format("column YEAR: want a year, got `{}`", row.fields[1].substr(0, 20));
    }
    id = {.year = *its_year, .number = *number};
    return std::nullopt;
  }
};

using Take = std::function<std::optional<std::string>(const CsvRow&)>;

std::optional<Error> read_file_of(const fs::path& folder, std::string_view name,
                                  const std::vector<CsvColumn>& columns, const Take& take,
                                  FarsRelease& release) {
  const auto file = file_in(folder, name);
  if (!file.has_value()) {
    return file.error();
  }
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 30U;
  const auto text = read_file(file.value(), largest);
  if (!text.has_value()) {
    return text.error();
  }
  const auto count = read_columns(text.value(), file.value().string(), columns, take);
  if (!count.has_value()) {
    return count.error();
  }
  if (count.value().broken > 0) {
    release.notes.push_back(
        fmt::format("{} of {} rows were passed over; the first: {}", count.value().broken,
                    count.value().broken + count.value().rows, count.value().first_broken));
  }
  return std::nullopt;
}

std::optional<Error> read_accidents(const fs::path& folder, FarsRelease& release,
                                    Crashes& crashes) {
  const auto columns = with_codes({{"ST_CASE"}, {"YEAR"}}, crash_columns);
  return read_file_of(
      folder, "accident.csv", columns,
      [&](const CsvRow& row) -> std::optional<std::string> {
        FarsCrash crash{.id = {}, .in_accident_file = true};
        auto broken = Keys{}.read(row, crash.id);
        broken = broken ? broken : read_codes(row, 2, crash_columns, crash);
        if (!broken && !crashes.emplace(crash.id, crash).second) {
          broken = fmt::format("want each crash once, got {} of {} again", crash.id.number,
                               crash.id.year);
        }
        return broken;
      },
      release);
}

std::optional<Error> read_vehicles(const fs::path& folder, const Keys& keys, FarsRelease& release,
                                   Crashes& crashes) {
  const auto columns = with_codes({{"ST_CASE"}, {"YEAR", false}, {"VEH_NO"}}, vehicle_columns);
  return read_file_of(
      folder, "vehicle.csv", columns,
      [&](const CsvRow& row) -> std::optional<std::string> {
        CrashId id;
        FarsVehicle vehicle;
        if (auto broken = keys.read(row, id)) {
          return broken;
        }
        const auto number = whole(row.fields[2]);
        if (!number || *number == 0) {
          return fmt::format("column VEH_NO: want a number from 1 on, got `{}`",
                             row.fields[2].substr(0, 20));
        }
        vehicle.number = *number;
        if (auto broken = read_codes(row, 3, vehicle_columns, vehicle)) {
          return broken;
        }
        FarsCrash& crash = crashes[id];
        crash.id = id;
        const auto is_this = [&](const FarsVehicle& one) { return one.number == vehicle.number; };
        if (std::any_of(crash.vehicles.begin(), crash.vehicles.end(), is_this)) {
          return fmt::format("column VEH_NO: want each vehicle of crash {} once, got {} again",
                             id.number, vehicle.number);
        }
        crash.vehicles.push_back(vehicle);
        return std::nullopt;
      },
      release);
}

std::optional<Error> read_persons(const fs::path& folder, const Keys& keys, FarsRelease& release,
                                  Crashes& crashes) {
  const auto columns = with_codes({{"ST_CASE"}, {"YEAR", false}, {"VEH_NO"}}, person_columns);
  return read_file_of(
      folder, "person.csv", columns,
      [&](const CsvRow& row) -> std::optional<std::string> {
        CrashId id;
        FarsPerson person;
        if (auto broken = keys.read(row, id)) {
          return broken;
        }
        const auto vehicle = whole(row.fields[2]);
        if (!vehicle) {
          return fmt::format("column VEH_NO: want a number, got `{}`", row.fields[2].substr(0, 20));
        }
        person.vehicle = *vehicle;
        auto broken = read_codes(row, 3, person_columns, person);
        const auto crash = crashes.find(id);
        if (!broken && crash != crashes.end()) {
          crash->second.persons.push_back(person);
        }
        return broken;
      },
      release);
}

/// The year of all of them; nullopt: of several.
std::optional<int> common_year(const Crashes& crashes) {
  const bool same = !crashes.empty() && crashes.begin()->first.year == crashes.rbegin()->first.year;
  return same ? std::optional(crashes.begin()->first.year) : std::nullopt;
}

void note_missing(FarsRelease& release, const fs::path& folder) {
  const auto tell = [&](auto lacks, const char* what) {
    const auto number = std::count_if(release.crashes.begin(), release.crashes.end(), lacks);
    if (number > 0) {
      release.notes.push_back(fmt::format("{}: of {} of {} crashes {}", folder.string(), number,
                                          release.crashes.size(), what));
    }
  };
  tell([](const FarsCrash& crash) { return !crash.in_accident_file; },
       "accident.csv has no row: light and junction are not known");
  tell([](const FarsCrash& crash) { return crash.vehicles.empty(); }, "vehicle.csv has no row");
  tell([](const FarsCrash& crash) { return crash.persons.empty(); }, "person.csv has no row");
}

}  // namespace

Result<FarsRelease> read_fars(const fs::path& folder) {
  FarsRelease release;
  Crashes crashes;
  if (auto problem = read_accidents(folder, release, crashes)) {
    return *problem;
  }
  const Keys keys{.year = common_year(crashes)};
  if (auto problem = read_vehicles(folder, keys, release, crashes)) {
    return *problem;
  }
  if (auto problem = read_persons(folder, keys, release, crashes)) {
    return *problem;
  }
  release.crashes.reserve(crashes.size());
  for (auto& [id, crash] : crashes) {
    std::stable_sort(
        crash.vehicles.begin(), crash.vehicles.end(),
        [](const FarsVehicle& a, const FarsVehicle& b) { return a.number < b.number; });
    release.crashes.push_back(std::move(crash));
  }
  note_missing(release, folder);
  return release;
}

Result<FarsRelease> joined(std::vector<FarsRelease> releases) {
  FarsRelease all;
  for (FarsRelease& one : releases) {
    all.crashes.insert(all.crashes.end(), std::move_iterator(one.crashes.begin()),
                       std::move_iterator(one.crashes.end()));
    all.notes.insert(all.notes.end(), one.notes.begin(), one.notes.end());
  }
  std::stable_sort(all.crashes.begin(), all.crashes.end(),
                   [](const FarsCrash& a, const FarsCrash& b) { return a.id < b.id; });
  const auto twice =
      std::adjacent_find(all.crashes.begin(), all.crashes.end(),
                         [](const FarsCrash& a, const FarsCrash& b) { return a.id == b.id; });
  if (twice != all.crashes.end()) {
    return Error{Error::Code::malformed,
                 fmt::format("want each crash in one folder, got ST_CASE {} of {} in two",
                             twice->id.number, twice->id.year)};
  }
  return all;
}

}  // namespace saca::crash_records
