#include "saca/lab/recordings/set_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/csv.h"
#include "saca/base/formats/checksummed_file.h"
#include "saca/base/formats/hdf5_reader.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::recordings {
namespace {

constexpr std::string_view set_format = "saca.traffic/1";
constexpr double largest_whole = 9007199254740992.0;  // 2^53: exact as a double

/// A number of every sample.
struct SampleColumn {
  const char* name;
  double (*of)(const Sample&);
  void (*put)(Sample&, double);
};

// Written as 32-bit numbers; names carry units.
constexpr std::array<SampleColumn, 16> sample_columns{{
    {"samples/yaw_rad", [](const Sample& s) { return s.X_WA.yaw; },
     [](Sample& s, double v) { s.X_WA.yaw = v; }},
    {"samples/speed_mps", [](const Sample& s) { return s.speed; },
     [](Sample& s, double v) { s.speed = v; }},
    {"samples/offset_m", [](const Sample& s) { return s.offset; },
     [](Sample& s, double v) { s.offset = v; }},
    {"samples/lane_heading_rad", [](const Sample& s) { return s.heading; },
     [](Sample& s, double v) { s.heading = v; }},
    {"samples/lane_width_m", [](const Sample& s) { return s.lane_width; },
     [](Sample& s, double v) { s.lane_width = v; }},
    {"samples/curvature_1pm", [](const Sample& s) { return s.curvature; },
     [](Sample& s, double v) { s.curvature = v; }},
    {"samples/lane_step", [](const Sample& s) { return static_cast<double>(s.lane_step); },
     // What is no step at all breaks the set's rules as 9 does.
     [](Sample& s, double v) { s.lane_step = std::abs(v) <= 1.0 ? static_cast<int>(v) : 9; }},
    {"samples/left_lane", [](const Sample& s) { return s.left_lane ? 1.0 : 0.0; },
     [](Sample& s, double v) { s.left_lane = v > 0.5; }},
    {"samples/right_lane", [](const Sample& s) { return s.right_lane ? 1.0 : 0.0; },
     [](Sample& s, double v) { s.right_lane = v > 0.5; }},
    {"samples/gap_m", [](const Sample& s) { return s.gap; },
     [](Sample& s, double v) { s.gap = v; }},
    {"samples/lead_speed_mps", [](const Sample& s) { return s.lead_speed; },
     [](Sample& s, double v) { s.lead_speed = v; }},
    {"samples/brake_pedal", [](const Sample& s) { return s.brake_pedal; },
     [](Sample& s, double v) { s.brake_pedal = v; }},
    {"samples/steering_rad", [](const Sample& s) { return s.steering; },
     [](Sample& s, double v) { s.steering = v; }},
    {"samples/throttle", [](const Sample& s) { return s.throttle; },
     [](Sample& s, double v) { s.throttle = v; }},
    {"samples/measured_acceleration_mps2", [](const Sample& s) { return s.measured_acceleration; },
     [](Sample& s, double v) { s.measured_acceleration = v; }},
    {"samples/measured_yaw_rate_radps", [](const Sample& s) { return s.measured_yaw_rate; },
     [](Sample& s, double v) { s.measured_yaw_rate = v; }},
}};

// --- writing
// --------------------------------------------------------------------------------------

void write_column(formats::Hdf5Writer& writer, const char* name,
                  const std::vector<double>& column) {
  writer.numbers<double>(name, {column.size()}, {column.data()});
}

/// One value for each of a list's elements.
template <class List, class Of>
std::vector<double> column_of(const List& list, const Of& of) {
  std::vector<double> column;
  column.reserve(list.size());
  for (const auto& element : list) {
    column.push_back(static_cast<double>(of(element)));
  }
  return column;
}

template <class List, class Of>
std::string lines_of(const List& list, const Of& of) {
  std::string lines;
  for (const auto& element : list) {
    lines += of(element);
    lines += '\n';
  }
  return lines;
}

std::vector<const RecordedVehicle*> vehicles_of(const RecordedSet& set) {
  std::vector<const RecordedVehicle*> vehicles;
  for (const Recording& recording : set.recordings) {
    for (const RecordedVehicle& vehicle : recording.vehicles) {
      vehicles.push_back(&vehicle);
    }
  }
  return vehicles;
}

std::vector<const Sample*> samples_of(const std::vector<const RecordedVehicle*>& vehicles) {
  std::vector<const Sample*> samples;
  for (const RecordedVehicle* const vehicle : vehicles) {
    for (const Sample& sample : vehicle->samples) {
      samples.push_back(&sample);
    }
  }
  return samples;
}

void write_recordings(formats::Hdf5Writer& writer, const std::vector<Recording>& recordings) {
  writer.group("recordings");
  writer.text("recordings/names", lines_of(recordings, [](const auto& r) { return r.name; }));
  writer.text("recordings/sites", lines_of(recordings, [](const auto& r) { return r.site; }));
  writer.text("recordings/groups", lines_of(recordings, [](const auto& r) { return r.group; }));
  write_column(writer, "recordings/step_s",
               column_of(recordings, [](const auto& r) { return r.step; }));
  write_column(writer, "recordings/num_vehicles",
               column_of(recordings, [](const auto& r) { return r.vehicles.size(); }));
}

void write_vehicles(formats::Hdf5Writer& writer,
                    const std::vector<const RecordedVehicle*>& vehicles) {
  writer.group("vehicles");
  write_column(writer, "vehicles/id", column_of(vehicles, [](const auto* v) { return v->id; }));
  writer.text("vehicles/types", lines_of(vehicles, [](const auto* v) { return v->type; }));
  write_column(writer, "vehicles/length_m",
               column_of(vehicles, [](const auto* v) { return v->length; }));
  write_column(writer, "vehicles/width_m",
               column_of(vehicles, [](const auto* v) { return v->width; }));
  write_column(writer, "vehicles/start_s",
               column_of(vehicles, [](const auto* v) { return v->start; }));
  write_column(writer, "vehicles/num_samples",
               column_of(vehicles, [](const auto* v) { return v->samples.size(); }));
}

void write_samples(formats::Hdf5Writer& writer, const std::vector<const Sample*>& samples) {
  writer.group("samples");
  write_column(writer, "samples/x_m",
               column_of(samples, [](const auto* s) { return s->X_WA.p.x; }));
  write_column(writer, "samples/y_m",
               column_of(samples, [](const auto* s) { return s->X_WA.p.y; }));
  std::vector<float> column(samples.size());
  for (const SampleColumn& kind : sample_columns) {
    std::transform(samples.begin(), samples.end(), column.begin(),
                   [&](const Sample* sample) { return static_cast<float>(kind.of(*sample)); });
    writer.numbers<float>(kind.name, {column.size()}, {column.data()});
  }
}

// --- reading
// --------------------------------------------------------------------------------------

/// As many lines as wanted; else it is rejected.
std::vector<std::string> read_lines(formats::Hdf5Reader& reader, const char* name,
                                    std::size_t wanted) {
  const std::string text = reader.text(name);
  std::vector<std::string> lines;
  for (std::string_view rest = text; !rest.empty();) {
    lines.emplace_back(cut_line(rest));
  }
  if (!reader.problem() && lines.size() != wanted) {
    reader.reject(fmt::format("data set {}", name), fmt::format("{} lines", wanted),
                  fmt::format("{}", lines.size()));
  }
  lines.resize(wanted);
  return lines;
}

/// How many numbers stand in a data set; 0 after a problem.
std::size_t size_of(formats::Hdf5Reader& reader, const char* name) {
  const std::vector<std::size_t> extents = reader.extents(name);
  if (!reader.problem() && extents.size() != 1) {
    reader.reject(fmt::format("data set {}", name), "a row of numbers", "another shape");
  }
  return reader.problem() ? 0 : extents[0];
}

template <class Real>
std::vector<Real> read_column(formats::Hdf5Reader& reader, const char* name, std::size_t size,
                              formats::Numbers allowed) {
  reader.want_numbers<Real>(name, {size});
  std::vector<Real> column(reader.problem() ? 0 : size);
  if (!reader.problem()) {
    reader.numbers<Real>(name, {size}, {column.data()}, allowed);
  }
  column.resize(size);
  return column;
}

/// Whole numbers in [least, most].
std::vector<std::int64_t> read_whole(formats::Hdf5Reader& reader, const char* name,
                                     std::size_t size, double least) {
  std::vector<std::int64_t> whole;
  for (const double value : read_column<double>(reader, name, size, formats::Numbers::finite)) {
    if (!reader.problem() &&
        !(value >= least && value <= largest_whole && value == std::floor(value))) {
      reader.reject(fmt::format("data set {}", name),
                    fmt::format("whole numbers from {} on", least), fmt::format("{}", value));
    }
    whole.push_back(reader.problem() ? 0 : static_cast<std::int64_t>(value));
  }
  return whole;
}

/// Rejects counts that do not add up to what they count.
void want_sum(formats::Hdf5Reader& reader, const char* name,
              const std::vector<std::int64_t>& counts, std::size_t wanted) {
  std::size_t sum = 0;
  for (const std::int64_t count : counts) {
    sum = std::min(sum + static_cast<std::size_t>(count), std::size_t{1} << 62);
  }
  if (!reader.problem() && sum != wanted) {
    reader.reject(fmt::format("data set {}", name), fmt::format("counts of {} together", wanted),
                  fmt::format("{}", sum));
  }
}

std::vector<Sample> read_samples(formats::Hdf5Reader& reader) {
  using formats::Numbers;
  const std::size_t size = size_of(reader, "samples/x_m");
  const auto x = read_column<double>(reader, "samples/x_m", size, Numbers::all);
  const auto y = read_column<double>(reader, "samples/y_m", size, Numbers::all);
  std::vector<Sample> samples(reader.problem() ? 0 : size);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].X_WA.p = {x[k], y[k]};
  }
  for (const SampleColumn& kind : sample_columns) {
    const auto column = read_column<float>(reader, kind.name, size, Numbers::all);
    for (std::size_t k = 0; k < samples.size() && !reader.problem(); ++k) {
      kind.put(samples[k], static_cast<double>(column[k]));
    }
  }
  return samples;
}

std::vector<RecordedVehicle> read_vehicles(formats::Hdf5Reader& reader) {
  using formats::Numbers;
  const std::size_t size = size_of(reader, "vehicles/id");
  const auto id = read_whole(reader, "vehicles/id", size, -largest_whole);
  const auto types = read_lines(reader, "vehicles/types", size);
  const auto length = read_column<double>(reader, "vehicles/length_m", size, Numbers::all);
  const auto width = read_column<double>(reader, "vehicles/width_m", size, Numbers::all);
  const auto start = read_column<double>(reader, "vehicles/start_s", size, Numbers::finite);
  const auto num_samples = read_whole(reader, "vehicles/num_samples", size, 1.0);
  const std::vector<Sample> samples = read_samples(reader);
  want_sum(reader, "vehicles/num_samples", num_samples, samples.size());
  std::vector<RecordedVehicle> vehicles;
  auto from = samples.begin();
  for (std::size_t k = 0; k < size && !reader.problem(); ++k) {
    const auto to = from + num_samples[k];
    vehicles.push_back({id[k], types[k], length[k], width[k], start[k], {from, to}});
    from = to;
  }
  return vehicles;
}

void read_recordings(formats::Hdf5Reader& reader, RecordedSet& set) {
  const std::size_t size = size_of(reader, "recordings/step_s");
  const auto names = read_lines(reader, "recordings/names", size);
  const auto sites = read_lines(reader, "recordings/sites", size);
  const auto groups = read_lines(reader, "recordings/groups", size);
  const auto step =
      read_column<double>(reader, "recordings/step_s", size, formats::Numbers::finite);
  const auto num_vehicles = read_whole(reader, "recordings/num_vehicles", size, 1.0);
  std::vector<RecordedVehicle> vehicles = read_vehicles(reader);
  want_sum(reader, "recordings/num_vehicles", num_vehicles, vehicles.size());
  auto from = std::make_move_iterator(vehicles.begin());
  for (std::size_t k = 0; k < size && !reader.problem(); ++k) {
    const auto to = from + num_vehicles[k];
    set.recordings.push_back({names[k], sites[k], groups[k], step[k], {from, to}});
    from = to;
  }
}

void read_skipped(formats::Hdf5Reader& reader, RecordedSet& set) {
  if (!reader.has("skipped")) {
    return;
  }
  const std::size_t size = size_of(reader, "skipped/counts");
  const auto reasons = read_lines(reader, "skipped/reasons", size);
  const auto counts = read_whole(reader, "skipped/counts", size, 1.0);
  for (std::size_t k = 0; k < size && !reader.problem(); ++k) {
    set.skipped[reasons[k]] = static_cast<std::size_t>(counts[k]);
  }
}

}  // namespace

std::optional<Error> write_set(const std::filesystem::path& path, const RecordedSet& set) {
  const std::optional<std::string> broken = broken_rule(set);
  expects(!broken, "the set breaks no rule");
  const std::vector<const RecordedVehicle*> vehicles = vehicles_of(set);
  formats::Hdf5Writer writer;
  writer.attribute(".", "format", std::string(set_format));
  write_recordings(writer, set.recordings);
  write_vehicles(writer, vehicles);
  write_samples(writer, samples_of(vehicles));
  if (!set.skipped.empty()) {
    writer.group("skipped");
    writer.text("skipped/reasons", lines_of(set.skipped, [](const auto& s) { return s.first; }));
    write_column(writer, "skipped/counts",
                 column_of(set.skipped, [](const auto& s) { return s.second; }));
  }
  const std::optional<std::string_view> body = writer.bytes();
  if (!body) {
    return Error{Error::Code::unwritable, path.string() + ": HDF5 cannot make the file in memory"};
  }
  return formats::write_checksummed(path, set_format, *body);
}

Result<RecordedSet> read_set(const std::filesystem::path& path) {
  if (const auto problem = formats::verify_checksum(path, set_format)) {
    return *problem;
  }
  try {
    formats::Hdf5Reader reader(path.string(), path);
    const std::string format = reader.text_attribute(".", "format");
    if (!reader.problem() && format != set_format) {
      reader.reject("attribute format", std::string(set_format), format);
    }
    RecordedSet set;
    read_recordings(reader, set);
    read_skipped(reader, set);
    if (const auto broken = broken_rule(set); broken && !reader.problem()) {
      reader.reject("contents", *broken);
    }
    if (reader.problem()) {
      return *reader.problem();
    }
    return set;
  } catch (const std::exception& problem) {
    return Error{Error::Code::unreadable,
                 fmt::format("{}: cannot be read: {}", path.string(), problem.what())};
  }
}

}  // namespace saca::recordings
