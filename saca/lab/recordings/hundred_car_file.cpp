#include "saca/lab/recordings/hundred_car_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "saca/base/core/csv.h"
#include "saca/base/core/units.h"
#include "saca/lab/recordings/series.h"

namespace saca::recordings {
namespace {

constexpr std::size_t num_columns = 79;

// Columns, counted from 0 (the dictionary counts from 1).
constexpr std::size_t sync_column = 1;
constexpr std::size_t speed_column = 4;
constexpr std::size_t yaw_rate_column = 6;
constexpr std::size_t acceleration_column = 9;
constexpr std::size_t left_mark_column = 14;  // of the lane tracker, in inches, > 0 to the right
constexpr std::size_t right_mark_column = 15;
constexpr std::size_t left_trust_column = 18;
constexpr std::size_t right_trust_column = 19;
constexpr std::size_t front_column = 20;  // seven ids; the rear radar's seven follow, and so on
constexpr std::size_t rear_column = 27;
constexpr std::size_t range_offset = 14;  // from an id to the same target's range
constexpr std::size_t rate_offset = 28;
constexpr std::size_t azimuth_offset = 42;
constexpr std::size_t brake_column = 77;

// The release has ghosts that close at up to 1,000 m/s. Ours: beyond what the radar sees, and any
// two cars do.
constexpr double farthest_seen = 500.0;  // [m]
constexpr double fastest_seen = 100.0;   // [m/s]

/// NaN for what the release writes for missing; nullopt for text.
std::optional<double> number(std::string_view field) {
  field = trimmed(field);
  return field.empty() || field == "." ? missing : finite_number(field);
}

/// A whole number of moderate size; nullopt otherwise.
std::optional<std::int64_t> whole(std::optional<double> value) {
  constexpr double most = 1e12;
  if (!value || !(std::abs(*value) < most) || *value != std::floor(*value)) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(*value);
}

Error malformed(std::string_view source, std::size_t line, const std::string& message) {
  return {Error::Code::malformed,
          std::string(source) + ":" + std::to_string(line) + ": " + message};
}

/// `side` is +1 where the radar's right is the car's left: at the rear.
StaticVector<RadarTarget, radar_columns> targets(const std::vector<double>& values,
                                                 std::size_t first, double side) {
  StaticVector<RadarTarget, radar_columns> seen;
  for (std::size_t k = first; k < first + radar_columns; ++k) {
    const std::optional<std::int64_t> id = whole(values[k]);
    const RadarTarget target{.id = id.value_or(0),
                             .range = from_feet(values[k + range_offset]),
                             .rate = from_feet(values[k + rate_offset]),
                             .azimuth = side * values[k + azimuth_offset]};
    if (target.id > 0 && target.range > 0.0 && target.range <= farthest_seen &&
        std::abs(target.rate) <= fastest_seen && std::isfinite(target.azimuth)) {
      seen.push_back(target);
    }
  }
  return seen;
}

HundredCarRow row_of(const std::vector<double>& values, std::int64_t sync) {
  HundredCarRow row;
  row.sync = sync;
  // -1: no composite speed could be made.
  row.speed = values[speed_column] >= 0.0 ? from_mph(values[speed_column]) : missing;
  row.yaw_rate = from_degrees(values[yaw_rate_column]);
  row.brake = values[brake_column] > 0.5;
  row.brake_known = !std::isnan(values[brake_column]);
  row.acceleration = from_g(values[acceleration_column]);
  row.left_mark = -from_inches(values[left_mark_column]);
  row.right_mark = -from_inches(values[right_mark_column]);
  const double trust = std::min(values[left_trust_column], values[right_trust_column]);
  row.mark_trust = std::isnan(values[left_trust_column] + values[right_trust_column]) ? 0.0 : trust;
  row.front = targets(values, front_column, -1.0);
  row.rear = targets(values, rear_column, 1.0);
  return row;
}

HundredCarEvent event_of(const std::vector<std::string_view>& fields, std::int64_t vehicle,
                         std::int64_t first_sync, std::int64_t last_sync) {
  const auto word = [&fields](std::size_t column) {
    return std::string(trimmed(fields[column - 1]));
  };
  return HundredCarEvent{.vehicle = vehicle,
                         .start_sync = first_sync,
                         .end_sync = last_sync,
                         .severity = word(5),
                         .nature = word(10),
                         .manoeuvre_before = word(11),
                         .precipitating = word(13),
                         .reaction = word(14),
                         .control_after = word(15),
                         .behaviour = word(16),
                         .surface = word(49),
                         .flow = word(50),
                         .lanes = word(51),
                         .alignment = word(55),
                         .locality = word(56),
                         .light = word(57),
                         .weather = word(58),
                         .lead_type = word(63),
                         .third_place = word(66),
                         .third_type = word(67)};
}

}  // namespace

Result<std::vector<HundredCarRow>> read_hundred_car_rows(std::string_view text,
                                                         std::string_view source,
                                                         std::int64_t event) {
  std::vector<HundredCarRow> rows;
  std::vector<double> values(num_columns);
  std::string_view rest = text;
  for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = cut_line(rest);
    if (line.empty()) {
      continue;
    }
    const std::vector<std::string_view> fields = fields_of(line, ',');
    if (whole(number(fields[0])) != event) {
      continue;
    }
    if (fields.size() != num_columns) {
      return malformed(source, line_number,
                       "want 79 columns, got " + std::to_string(fields.size()));
    }
    for (std::size_t k = 0; k < num_columns; ++k) {
      const std::optional<double> value = number(fields[k]);
      if (!value) {
        return malformed(source, line_number,
                         "column " + std::to_string(k + 1) +
                             ": want a number, `.` or nothing, got `" +
                             std::string(fields[k].substr(0, 20)) + "`");
      }
      values[k] = *value;
    }
    const std::optional<std::int64_t> sync = whole(values[sync_column]);
    if (!sync || (!rows.empty() && *sync != rows.back().sync + 1)) {
      const std::string wanted =
          rows.empty() ? "a whole number" : std::to_string(rows.back().sync + 1);
      return malformed(source, line_number,
                       "column 2 (sync): want " + wanted + ", got " + std::string(fields[1]));
    }
    rows.push_back(row_of(values, *sync));
  }
  if (rows.empty()) {
    return Error{Error::Code::malformed, std::string(source) + ": want rows of event " +
                                             std::to_string(event) + " (column 1), got none"};
  }
  return rows;
}

bool is_hundred_car_series(std::string_view file_name) {
  return file_name.starts_with("HundredCar_");
}

std::string_view cut_hundred_car_event(std::string_view& rest) {
  const auto first_field = [](std::string_view text) { return text.substr(0, text.find(',')); };
  const std::string_view whole = rest;
  const std::string_view event = first_field(whole.substr(0, whole.find('\n')));
  while (!rest.empty() && first_field(rest.substr(0, rest.find('\n'))) == event) {
    (void)cut_line(rest);
  }
  return whole.substr(0, whole.size() - rest.size());
}

std::optional<std::int64_t> hundred_car_number(std::string_view row) {
  constexpr std::int64_t most = 1'000'000'000;
  const auto event = whole(finite_number(trimmed(row.substr(0, row.find_first_of(",\r\n")))));
  return event && *event >= 0 && *event <= most ? event : std::nullopt;
}

Result<HundredCarEvent> read_hundred_car_event(std::string_view text, std::string_view source,
                                               std::int64_t event) {
  std::string_view rest = text;
  for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
    const std::vector<std::string_view> fields = fields_of(cut_line(rest), '\t');
    if (whole(number(fields[0])) != event) {
      continue;
    }
    constexpr std::size_t num_fields = 69;
    if (fields.size() != num_fields) {
      return malformed(source, line_number,
                       "want 69 tab-separated columns, got " + std::to_string(fields.size()));
    }
    const std::optional<std::int64_t> vehicle = whole(number(fields[1]));
    if (!vehicle) {
      return malformed(source, line_number,
                       "column 2: want the vehicle's number, got `" + std::string(fields[1]) + "`");
    }
    const std::optional<std::int64_t> start = whole(number(fields[2]));
    const std::optional<std::int64_t> end = whole(number(fields[3]));
    if (!start || !end || *end < *start) {
      return malformed(source, line_number,
                       "columns 3 and 4: want the event's first and last sync, got `" +
                           std::string(fields[2]) + "` and `" + std::string(fields[3]) + "`");
    }
    return event_of(fields, *vehicle, *start, *end);
  }
  return Error{Error::Code::malformed, std::string(source) + ": want a row of event " +
                                           std::to_string(event) + ", got none"};
}

}  // namespace saca::recordings
