#include "saca/lab/recordings/ngsim_csv.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "saca/base/core/csv.h"
#include "saca/base/core/units.h"

namespace saca::recordings {
namespace {

/// The columns that are used, in the order in which `columns_` holds their places.
struct Column {
  enum : std::size_t {
    vehicle,
    frame,
    time,
    x,
    y,
    length,
    width,
    vehicle_class,
    speed,
    lane,
    preceding,
    location,
    preceding_y,
    preceding_length,
    preceding_speed,
    count
  };
};
constexpr std::array<std::string_view, Column::count> wanted_names{
    "vehicle_id",        "frame_id",         "global_time",  "local_x", "local_y",   "v_length",
    "v_width",           "v_class",          "v_vel",        "lane_id", "preceding", "location",
    "preceding_local_y", "preceding_length", "preceding_vel"};
/// That are known and not used.
constexpr std::array<std::string_view, 21> other_names{
    "total_frames",    "global_x",        "global_y",     "v_acc",    "o_zone",    "d_zone",
    "int_id",          "section_id",      "direction",    "movement", "following", "space_headway",
    "time_headway",    "space_hdwy",      "time_hdwy",    "pair_id",  "time",      "duration",
    "preceding_width", "preceding_class", "preceding_acc"};
/// Of the older files, which have no line of names.
constexpr std::string_view old_names =
    "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_length,v_"
    "Width,"
    "v_Class,v_Vel,v_Acc,Lane_ID,Preceding,Following,Space_Headway,Time_Headway";
constexpr std::size_t num_old_arterial = 24;
constexpr auto nowhere = static_cast<std::size_t>(-1);

// What a number may be, in the file's units: far beyond all that was recorded.
constexpr double most_id = 1e9;
constexpr double most_time = 1e14;    // [ms]
constexpr double farthest_row = 1e5;  // [ft] or [m]
constexpr double longest_row = 300.0;
constexpr double fastest_row = 500.0;  // [ft/s] or [m/s]

std::string small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return small;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (const std::string_view word : fields_of(line, ' ')) {
    if (!trimmed(word).empty()) {
      words.push_back(trimmed(word));
    }
  }
  return words;
}

/// "us-101" is the site us101.
std::string site_named(std::string_view location) {
  std::string site = small_letters(trimmed(location));
  std::erase_if(site, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  constexpr std::size_t longest = 20;
  return site.empty() ? "ngsim" : site.substr(0, longest);
}

}  // namespace

NgsimReader::NgsimReader(std::string source, NgsimTable& table)
    : source_(std::move(source)), table_(table) {}

void NgsimReader::fail(const std::string& message, Error::Code code) {
  if (!problem_) {
    problem_ = Error{code, source_ + ":" + std::to_string(line_) + ": " + message};
  }
}

double NgsimReader::number(const std::vector<std::string_view>& fields, std::size_t column,
                           double least, double most) {
  const std::size_t place = columns_[column];
  const auto value = finite_number(fields[place]);
  const std::string shown = "column " + names_[place] + ": want ";
  const std::string came = ", got `" + std::string(fields[place].substr(0, 20)) + "`";
  if (!value) {
    fail(shown + "a number" + came);
  } else if (*value < least || *value > most) {
    fail(shown + "a number from " + std::to_string(least) + " to " + std::to_string(most) + came,
         Error::Code::out_of_range);
  }
  return problem_ ? 0.0 : *value;
}

std::int64_t NgsimReader::whole(const std::vector<std::string_view>& fields, std::size_t column,
                                double least, double most) {
  const double value = number(fields, column, least, most);
  if (value != std::floor(value)) {
    fail("column " + names_[columns_[column]] + ": want a whole number, got `" +
         std::string(fields[columns_[column]].substr(0, 20)) + "`");
  }
  return problem_ ? 0 : static_cast<std::int64_t>(value);
}

void NgsimReader::take(std::string_view bytes) {
  while (!bytes.empty() && !problem_) {
    const std::size_t end = bytes.find('\n');
    constexpr std::size_t longest_line = 10'000;
    if (rest_.size() + std::min(end, bytes.size()) > longest_line) {
      ++line_;
      fail("want lines of at most 10000 bytes, got a longer one");
    } else if (end == std::string_view::npos) {
      rest_ += bytes;
      return;
    } else if (rest_.empty()) {
      take_line(bytes.substr(0, end), false);
    } else {
      rest_ += bytes.substr(0, end);
      take_line(rest_, false);
      rest_.clear();
    }
    bytes.remove_prefix(std::min(end, bytes.size() - 1) + 1);
  }
}

std::optional<Error> NgsimReader::finish() {
  if (!rest_.empty() && !problem_) {
    take_line(rest_, true);
  }
  if (num_rows_ == 0) {
    fail("want at least one row, got none");
  }
  return problem_;
}

void NgsimReader::take_line(std::string_view line, bool cut_off) {
  ++line_;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (line_ == 1 && line.substr(0, byte_order_mark.size()) == byte_order_mark) {
    line.remove_prefix(byte_order_mark.size());
  }
  line = trimmed(line.substr(0, line.find('\r')));
  if (line.empty()) {
    return;
  }
  if (mark_ == '\0') {
    const bool has_names = line.find(',') != std::string_view::npos;
    mark_ = has_names ? ',' : ' ';
    if (has_names) {
      take_names(line);
      return;
    }
    if (words_of(line).size() == num_old_arterial) {
      fail("want a freeway's file of 18 columns, got an arterial's of 24: its lanes need a map");
      return;
    }
    take_names(old_names);
  }
  const std::vector<std::string_view> fields = mark_ == ',' ? fields_of(line, ',') : words_of(line);
  if (cut_off && fields.size() <= names_.size()) {
    ++table_.skipped["row: the last one, without a line's end"];
    ++num_rows_;
  } else if (fields.size() == names_.size()) {
    take_row(fields);
  } else {
    fail("want " + std::to_string(names_.size()) + " columns, got " +
         std::to_string(fields.size()));
  }
}

void NgsimReader::take_names(std::string_view line) {
  columns_.assign(Column::count, nowhere);
  for (const std::string_view field : fields_of(line, ',')) {
    const std::string name = small_letters(trimmed(field));
    const auto* const found = std::find(wanted_names.begin(), wanted_names.end(), name);
    if (found != wanted_names.end()) {
      const auto which = static_cast<std::size_t>(found - wanted_names.begin());
      if (columns_[which] != nowhere) {
        fail("want each column once, got two named " + name);
      }
      columns_[which] = names_.size();
    } else if (std::find(other_names.begin(), other_names.end(), name) == other_names.end()) {
      fail("want columns of NGSIM, got one named `" + name.substr(0, 40) + "`");
    }
    names_.push_back(name);
  }
  pairs_ = std::find(names_.begin(), names_.end(), "pair_id") != names_.end();
  for (std::size_t k = 0; k < Column::count; ++k) {
    const bool of_pairs =
        k == Column::preceding_y || k == Column::preceding_length || k == Column::preceding_speed;
    const bool is_needed =
        pairs_ ? k != Column::time && k != Column::location : !of_pairs && k != Column::location;
    if (is_needed && columns_[k] == nowhere) {
      fail("want a column " + std::string(wanted_names[k]) + ", got none");
    }
  }
}

void NgsimReader::take_row(const std::vector<std::string_view>& fields) {
  ++num_rows_;
  NgsimKey key{pairs_ ? "i80" : "ngsim", 0};
  if (columns_[Column::location] != nowhere) {
    key.site = site_named(fields[columns_[Column::location]]);
    if (key.site == "lankershim" || key.site == "peachtree") {
      ++table_.skipped["row: of an arterial, whose lanes need a map"];
      return;
    }
  }
  constexpr double least_size = 0.1;
  const auto length_of = [this](double length) { return pairs_ ? length : from_feet(length); };
  NgsimRow row;
  row.vehicle = whole(fields, Column::vehicle, 0.0, most_id);
  row.frame = whole(fields, Column::frame, 0.0, most_id);
  row.right = length_of(number(fields, Column::x, -farthest_row, farthest_row));
  row.along = length_of(number(fields, Column::y, -farthest_row, farthest_row));
  row.length = length_of(number(fields, Column::length, least_size, longest_row));
  row.width = length_of(number(fields, Column::width, least_size, longest_row));
  row.speed = length_of(number(fields, Column::speed, 0.0, fastest_row));
  row.vehicle_class = static_cast<int>(whole(fields, Column::vehicle_class, 0.0, 100.0));
  row.lane = static_cast<int>(whole(fields, Column::lane, 0.0, 1000.0));
  row.preceding = whole(fields, Column::preceding, 0.0, most_id);
  if (pairs_) {
    row.lead_along = number(fields, Column::preceding_y, -farthest_row, farthest_row);
    row.lead_length = number(fields, Column::preceding_length, least_size, longest_row);
    row.lead_speed = number(fields, Column::preceding_speed, 0.0, fastest_row);
  } else {
    constexpr double frame_ms = 1000.0 * ngsim_step;
    const double first = static_cast<double>(whole(fields, Column::time, 0.0, most_time)) -
                         frame_ms * static_cast<double>(row.frame);
    key.minute = std::llround(first / 60'000.0);
  }
  if (!problem_) {
    table_.recordings[key].push_back(row);
  }
}

}  // namespace saca::recordings
