#include "saca/thinking/danger/value_file.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <string_view>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/names.h"
#include "saca/base/formats/checksummed_file.h"
#include "saca/base/formats/hdf5_reader.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::danger {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view file_format = "saca.value/2";
constexpr std::size_t most_cells = std::size_t{1} << 32;

/// Slowest axis first, as HDF5 has it.
std::vector<std::size_t> extents_of(const Grid& grid, std::optional<std::size_t> times) {
  std::vector<std::size_t> extents;
  if (times) {
    extents.push_back(*times);
  }
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    extents.push_back(static_cast<std::size_t>(axis->points));
  }
  return extents;
}

bool all_finite(const auto& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](auto x) { return std::isfinite(x); });
}
bool none_negative(const std::vector<float>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return x >= 0.0F; });
}

/// nullopt: they are in order.
std::optional<std::string> wrong_times(const std::vector<double>& times) {
  if (times.empty() || !all_finite(times) || !(times.front() >= 0.0)) {
    return "at least one time, all >= 0 and finite";
  }
  const auto not_later =
      std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return a >= b; });
  return not_later == times.end() ? std::nullopt
                                  : std::optional<std::string>("times that increase");
}

// --- writing
// --------------------------------------------------------------------------------------

void write_axis(formats::Hdf5Writer& writer, const std::string& where, const Axis& axis) {
  writer.group(where);
  writer.attribute(where, "name", axis.name);
  writer.attribute(where, "first", axis.first);
  writer.attribute(where, "last", axis.last);
  writer.attribute(where, "points", std::int32_t{axis.points});
  writer.attribute(where, "edge", std::string(name_of(axis.edge, edge_names)));
  writer.attribute(where, "stretch", axis.stretch);
  writer.attribute(where, "turned", axis.turned ? static_cast<std::int32_t>(*axis.turned) : -1);
}

/// Bytes of a file that cannot be compressed, and a little more.
std::size_t largest_size(const Solution& solved) {
  const std::size_t bytes = solved.doubles() ? sizeof(double) : sizeof(float);
  const std::size_t numbers = solved.times.size() * num_cells(solved.grid) * bytes +
                              solved.error.size() * sizeof(float) + solved.problem.size();
  return numbers + numbers / 32 + (std::size_t{1} << 18);
}

void write_parts(formats::Hdf5Writer& writer, const Solution& solved) {
  writer.attribute(".", "format", std::string(file_format));
  writer.attribute(".", "complete", std::int32_t{solved.complete});
  writer.attribute(".", "scheme", solved.scheme);
  writer.attribute(".", "dimensions", static_cast<std::int32_t>(solved.grid.axes.size()));
  for (std::size_t d = 0; d < solved.grid.axes.size(); ++d) {
    write_axis(writer, fmt::format("axis_{}", d), solved.grid.axes[d]);
  }
  writer.text("problem", solved.problem);
  writer.numbers<double>("times", {solved.times.size()}, {solved.times.data()});
  std::visit(
      [&]<class Real>(const Snapshots<Real>& snapshots) {
        std::vector<const Real*> parts;
        for (const std::vector<Real>& values : snapshots) {
          parts.push_back(values.data());
        }
        writer.numbers<Real>("values", extents_of(solved.grid, snapshots.size()), parts);
      },
      solved.values);
  if (!solved.error.empty()) {
    writer.numbers<float>("error", extents_of(solved.grid, std::nullopt), {solved.error.data()});
  }
}

// --- reading
// --------------------------------------------------------------------------------------

Axis read_axis(formats::Hdf5Reader& reader, const std::string& where) {
  Axis axis{.name = reader.text_attribute(where, "name"),
            .first = reader.number(where, "first"),
            .last = reader.number(where, "last"),
            .points = reader.whole(where, "points", 1, std::numeric_limits<std::int32_t>::max())};
  const std::string edge = reader.text_attribute(where, "edge");
  if (const auto known = value_from<Edge>(edge, edge_names)) {
    axis.edge = *known;
  } else {
    reader.reject(fmt::format("attribute {}/edge", where), "open, periodic or mirrored", edge);
  }
  axis.stretch = reader.number(where, "stretch");
  const std::int32_t turned = reader.whole(where, "turned", -1, std::int32_t{max_dimensions} - 1);
  if (turned >= 0) {
    axis.turned = static_cast<std::size_t>(turned);
  }
  return axis;
}

Grid read_grid(formats::Hdf5Reader& reader) {
  Grid grid;
  const std::int32_t dimensions = reader.whole(".", "dimensions", 1, std::int32_t{max_dimensions});
  for (std::int32_t d = 0; d < dimensions && !reader.problem(); ++d) {
    grid.axes.push_back(read_axis(reader, fmt::format("axis_{}", d)));
  }
  if (reader.problem()) {
    return grid;
  }
  if (const auto rule = broken_rule(grid)) {
    reader.reject("grid", *rule);
    return grid;
  }
  std::size_t cells = 1;
  for (const Axis& axis : grid.axes) {
    cells *= static_cast<std::size_t>(axis.points);  // each factor < 2^31: no overflow before
    if (cells > most_cells) {
      reader.reject("grid", fmt::format("at most {} cells", most_cells), "more");
      return grid;
    }
  }
  return grid;
}

std::vector<double> read_times(formats::Hdf5Reader& reader) {
  const std::vector<std::size_t> came = reader.extents("times");
  if (reader.problem()) {
    return {};
  }
  if (came.size() != 1 || came[0] < 1) {
    reader.reject("data set times", "a row of numbers", "another shape");
    return {};
  }
  reader.want_numbers<double>("times", came);
  std::vector<double> times(reader.problem() ? 0 : came[0]);
  reader.numbers<double>("times", came, {times.data()});
  if (const auto wanted = wrong_times(times); wanted && !reader.problem()) {
    reader.reject("data set times", *wanted, fmt::format("{}", fmt::join(times, ", ")));
  }
  return times;
}

template <class Real>
Snapshots<Real> read_snapshots(formats::Hdf5Reader& reader, const Solution& solved) {
  const std::vector<std::size_t> wanted = extents_of(solved.grid, solved.times.size());
  reader.want_numbers<Real>("values", wanted);
  if (reader.problem()) {
    return {};
  }
  Snapshots<Real> all(solved.times.size(), std::vector<Real>(num_cells(solved.grid)));
  std::vector<Real*> parts;
  for (std::vector<Real>& values : all) {
    parts.push_back(values.data());
  }
  reader.numbers<Real>("values", wanted, parts);
  return all;
}

std::vector<float> read_error(formats::Hdf5Reader& reader, const Grid& grid) {
  if (!reader.has("error")) {
    return {};
  }
  std::vector<float> error(num_cells(grid));
  reader.numbers<float>("error", extents_of(grid, std::nullopt), {error.data()});
  if (!reader.problem() && !none_negative(error)) {
    reader.reject("data set error", "numbers >= 0", "others");
  }
  return error;
}

/// What `reader` has no problem with.
Solution read_parts(formats::Hdf5Reader& reader) {
  Solution solved;
  const std::string format = reader.text_attribute(".", "format");
  if (!reader.problem() && format != file_format) {
    reader.reject("attribute format", std::string(file_format), format);
  }
  solved.complete = reader.whole(".", "complete", 0, 1) == 1;
  solved.scheme = reader.text_attribute(".", "scheme");
  solved.grid = read_grid(reader);
  solved.problem = reader.text("problem");
  solved.times = read_times(reader);
  if (reader.problem()) {
    return solved;
  }
  if (reader.is_of<double>("values")) {
    solved.values = read_snapshots<double>(reader, solved);
  } else {
    solved.values = read_snapshots<float>(reader, solved);
  }
  solved.error = read_error(reader, solved.grid);
  return solved;
}

}  // namespace

std::vector<float> snapshot(const Solution& solved, std::size_t time) {
  return std::visit(
      [&](const auto& snapshots) {
        expects(time < snapshots.size(), "there is such a snapshot");
        std::vector<float> values(snapshots[time].size());
        std::transform(snapshots[time].begin(), snapshots[time].end(), values.begin(),
                       [](auto value) { return static_cast<float>(value); });
        return values;
      },
      solved.values);
}

std::size_t nearest_snapshot(const Solution& solved, double time) {
  expects(!solved.times.empty(), "there is a snapshot");
  const auto nearest = std::min_element(
      solved.times.begin(), solved.times.end(),
      [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
  return static_cast<std::size_t>(nearest - solved.times.begin());
}

std::optional<Error> write_solved(const fs::path& path, const Solution& solved) {
  expects(!broken_rule(solved.grid), "the grid breaks no rule");
  expects(!wrong_times(solved.times), "times are finite, >= 0 and increase");
  const std::size_t cells = num_cells(solved.grid);
  expects(solved.error.empty() || solved.error.size() == cells, "one error per cell, or none");
  expects(all_finite(solved.error) && none_negative(solved.error), "errors are finite, >= 0");
  std::visit(
      [&](const auto& snapshots) {
        expects(snapshots.size() == solved.times.size(), "values at each time");
        for (const auto& values : snapshots) {
          expects(values.size() == cells, "one value per cell");
          expects(all_finite(values), "values are finite");
        }
      },
      solved.values);
  formats::Hdf5Writer writer(largest_size(solved));
  write_parts(writer, solved);
  const std::optional<std::string_view> body = writer.bytes();
  if (!body) {
    return Error{Error::Code::unwritable, path.string() + ": HDF5 cannot make the file in memory"};
  }
  return formats::write_checksummed(path, file_format, *body);
}

Result<Solution> read_solved(const fs::path& path) {
  if (const auto problem = formats::verify_checksum(path, file_format)) {
    return *problem;
  }
  try {
    formats::Hdf5Reader reader(path.string(), path);
    Solution solved = read_parts(reader);
    if (reader.problem()) {
      return *reader.problem();
    }
    return solved;
  } catch (const std::exception& problem) {
    return Error{Error::Code::unreadable,
                 fmt::format("{}: cannot be read: {}", path.string(), problem.what())};
  }
}

}  // namespace saca::danger
