#include "saca/reach/value_file.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>

#include "saca/core/contract.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"

namespace saca::reach {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view file_format = "saca.value/1";
constexpr std::string_view any_format = "saca.value/";
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t head_size = 512;      // a user block, which HDF5 wants to be of such a size
constexpr hsize_t chunk_numbers = 1 << 16;  // 256 or 512 KiB at a time
constexpr unsigned deflate_level = 1;       // higher ones are far slower and save a few per cent
constexpr std::size_t most_cells = std::size_t{1} << 32;
constexpr hsize_t deflates_at_most = 1100;  // to one byte; zlib: 1032
constexpr std::array<std::pair<Edge, std::string_view>, 3> edge_names{
    {{Edge::open, "open"}, {Edge::periodic, "periodic"}, {Edge::mirrored, "mirrored"}}};

// --- HDF5
// -----------------------------------------------------------------------------------------

/// The serial library works for one thread at a time; its own messages are kept quiet meanwhile.
class Hdf5Session {
 public:
  Hdf5Session() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Session() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (good()) {
      close_(id_);
    }
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;

  [[nodiscard]] bool good() const { return id_ >= 0; }
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// A file in memory: what is written to the disk, or came from it, is one run of bytes.
Hdf5Handle memory_file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = std::size_t{1} << 22;
  H5Pset_fapl_core(access.id(), growth, 0);
  return access;
}

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(size, 1));  // none may be empty
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

template <class Real>
hid_t file_type() {
  return sizeof(Real) == sizeof(double) ? H5T_IEEE_F64LE : H5T_IEEE_F32LE;
}
template <class Real>
hid_t memory_type() {
  return sizeof(Real) == sizeof(double) ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
}

/// Slowest axis first, as HDF5 has it.
std::vector<hsize_t> shape_of(const Grid& grid, std::optional<std::size_t> times) {
  std::vector<hsize_t> shape;
  if (times) {
    shape.push_back(*times);
  }
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    shape.push_back(static_cast<hsize_t>(axis->points));
  }
  return shape;
}

// --- writing
// --------------------------------------------------------------------------------------

/// Builds the HDF5 part; remembers whether all went well.
class ValueWriter {
 public:
  ValueWriter() : access_(memory_file_access()), file_(create(access_)) {}

  void attribute(hid_t object, const char* name, double value) {
    scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
  }
  void attribute(hid_t object, const char* name, std::int32_t value) {
    scalar(object, name, H5T_STD_I32LE, H5T_NATIVE_INT32, &value);
  }
  void attribute(hid_t object, const char* name, const std::string& text) {
    const Hdf5Handle type = text_type(text.size());
    scalar(object, name, type.id(), type.id(), text.c_str());
  }

  void axis(const std::string& where, const Axis& axis) {
    const Hdf5Handle group(H5Gcreate2(file(), where.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Gclose);
    note(group.good());
    attribute(group.id(), "name", axis.name);
    attribute(group.id(), "first", axis.first);
    attribute(group.id(), "last", axis.last);
    attribute(group.id(), "points", std::int32_t{axis.points});
    const auto* const edge = std::find_if(edge_names.begin(), edge_names.end(),
                                          [&](const auto& e) { return e.first == axis.edge; });
    attribute(group.id(), "edge", std::string(edge->second));
    attribute(group.id(), "stretch", axis.stretch);
    attribute(group.id(), "turned", axis.turned ? static_cast<std::int32_t>(*axis.turned) : -1);
  }

  void text(const char* name, const std::string& text) {
    const Hdf5Handle type = text_type(text.size());
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle layout = timeless();
    const Hdf5Handle set(
        H5Dcreate2(file(), name, type.id(), space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
        H5Dclose);
    note(set.good() &&
         H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0);
  }

  /// A data set whose rows (all but the first axis) are written one after another.
  template <class Real>
  void numbers(const char* name, const std::vector<hsize_t>& shape,
               const std::vector<const Real*>& rows) {
    const auto rank = static_cast<int>(shape.size());
    const Hdf5Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose);
    const Hdf5Handle layout = chunked(shape);
    const Hdf5Handle set(H5Dcreate2(file(), name, file_type<Real>(), space.id(), H5P_DEFAULT,
                                    layout.id(), H5P_DEFAULT),
                         H5Dclose);
    note(space.good() && set.good());
    std::vector<hsize_t> count = shape;
    count[0] /= rows.size();
    const Hdf5Handle row_space(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
    std::vector<hsize_t> start(shape.size(), 0);
    for (const Real* const row : rows) {
      note(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                               nullptr) >= 0 &&
           H5Dwrite(set.id(), memory_type<Real>(), row_space.id(), space.id(), H5P_DEFAULT, row) >=
               0);
      start[0] += count[0];
    }
  }

  /// All that was written; nullopt: something went wrong.
  [[nodiscard]] std::optional<std::string> bytes() {
    note(H5Fflush(file(), H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = good_ ? H5Fget_file_image(file(), nullptr, 0) : -1;
    if (size <= 0) {
      return std::nullopt;
    }
    std::string image(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file(), image.data(), image.size()) != size) {
      return std::nullopt;
    }
    return image;
  }

  [[nodiscard]] hid_t file() const { return file_.id(); }

 private:
  static Hdf5Handle create(const Hdf5Handle& access) {
    return {H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose};
  }

  /// A data set that does not note when it was made: the same values make the same file.
  static Hdf5Handle timeless() {
    Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(layout.id(), false);
    return layout;
  }

  static Hdf5Handle chunked(const std::vector<hsize_t>& shape) {
    std::vector<hsize_t> chunk(shape.size(), 1);
    hsize_t room = chunk_numbers;
    for (std::size_t d = shape.size(); d-- > 0 && room > 1; room /= chunk[d]) {
      chunk[d] = std::min(shape[d], room);
    }
    Hdf5Handle layout = timeless();
    H5Pset_chunk(layout.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(layout.id());
    H5Pset_deflate(layout.id(), deflate_level);
    return layout;
  }

  void scalar(hid_t object, const char* name, hid_t stored, hid_t given, const void* value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle attribute(
        H5Acreate2(object, name, stored, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    note(attribute.good() && H5Awrite(attribute.id(), given, value) >= 0);
  }

  void note(bool went_well) { good_ = good_ && went_well; }

  Hdf5Handle access_;
  Hdf5Handle file_;
  bool good_ = true;
};

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

std::optional<std::string> hdf5_part(const Solved& solved) {
  const Hdf5Session session;
  ValueWriter writer;
  writer.attribute(writer.file(), "format", std::string(file_format));
  writer.attribute(writer.file(), "complete", std::int32_t{solved.complete});
  writer.attribute(writer.file(), "dimensions", static_cast<std::int32_t>(solved.grid.axes.size()));
  for (std::size_t d = 0; d < solved.grid.axes.size(); ++d) {
    writer.axis(fmt::format("axis_{}", d), solved.grid.axes[d]);
  }
  writer.text("problem", solved.problem);
  writer.numbers<double>("times", {solved.times.size()}, {solved.times.data()});
  std::visit(
      [&]<class Real>(const Snapshots<Real>& snapshots) {
        std::vector<const Real*> rows;
        for (const std::vector<Real>& values : snapshots) {
          rows.push_back(values.data());
        }
        writer.numbers<Real>("values", shape_of(solved.grid, snapshots.size()), rows);
      },
      solved.values);
  if (!solved.error.empty()) {
    writer.numbers<float>("error", shape_of(solved.grid, std::nullopt), {solved.error.data()});
  }
  return writer.bytes();
}

/// The first 512 bytes: format, size and check sum of what follows.
std::string head_of(std::string_view body) {
  Fnv sum;
  sum.add(body);
  std::string head =
      fmt::format("{}\nbytes {}\nfnv1a {:016x}\n", file_format, body.size(), sum.value());
  head.resize(head_size, '\0');
  return head;
}

// --- reading
// --------------------------------------------------------------------------------------

/// Reads strictly: the first thing that is wrong is remembered, and nothing is read any more.
class ValueReader {
 public:
  ValueReader(std::string source, std::string_view body)
      : source_(std::move(source)), access_(memory_file_access()), file_(open(access_, body)) {
    if (!file_.good()) {
      reject("file", "HDF5", "what HDF5 cannot open");
    }
  }

  [[nodiscard]] Solved read() {
    Solved solved;
    const std::string format = text_attribute(".", "format");
    if (!problem_ && format != file_format) {
      reject("attribute format", std::string(file_format), format);
    }
    solved.complete = whole(".", "complete", 0, 1) == 1;
    const std::int32_t dimensions = whole(".", "dimensions", 1, std::int32_t{max_dimensions});
    for (std::int32_t d = 0; d < dimensions && !problem_; ++d) {
      solved.grid.axes.push_back(axis(fmt::format("axis_{}", d)));
    }
    check(solved.grid);
    solved.problem = text("problem");
    solved.times = times();
    if (!problem_) {
      values(solved);
    }
    if (!problem_ && H5Lexists(file_.id(), "error", H5P_DEFAULT) > 0) {
      solved.error.resize(num_cells(solved.grid));
      numbers<float>("error", shape_of(solved.grid, std::nullopt), {solved.error.data()});
      if (!problem_ && !none_negative(solved.error)) {
        reject("data set error", "numbers >= 0", "others");
      }
    }
    return solved;
  }

  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  static Hdf5Handle open(const Hdf5Handle& access, std::string_view body) {
    std::string image(body);  // the interface wants to be able to change it
    H5Pset_file_image(access.id(), image.data(), image.size());
    return {H5Fopen("in memory", H5F_ACC_RDONLY, access.id()), H5Fclose};
  }

  void reject(const std::string& part, const std::string& wanted, const std::string& came) {
    if (!problem_) {
      problem_ = Error{Error::Code::malformed,
                       fmt::format("{}: {}: want {}, got {}", source_, part, wanted, came)};
    }
  }

  /// An attribute of the right kind, holding one value; else it is rejected.
  Hdf5Handle attribute(const std::string& object, const char* name, H5T_class_t kind,
                       const std::string& wanted) {
    Hdf5Handle found(
        problem_ ? H5I_INVALID_HID
                 : H5Aopen_by_name(file_.id(), object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const std::string part = object == "." ? fmt::format("attribute {}", name)
                                           : fmt::format("attribute {}/{}", object, name);
    if (!found.good()) {
      reject(part, wanted, "none");
      return found;
    }
    const Hdf5Handle space(H5Aget_space(found.id()), H5Sclose);
    const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
    if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_class(type.id()) != kind ||
        (kind == H5T_STRING && H5Tis_variable_str(type.id()) != 0)) {
      reject(part, wanted, "another type or shape");
    }
    return found;
  }

  double number(const std::string& object, const char* name) {
    double value = 0.0;
    const Hdf5Handle found = attribute(object, name, H5T_FLOAT, "a number");
    if (!problem_ && H5Aread(found.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
      reject(fmt::format("attribute {}/{}", object, name), "a number", "what cannot be read");
    }
    return value;
  }

  std::int32_t whole(const std::string& object, const char* name, std::int32_t least,
                     std::int32_t most) {
    std::int32_t value = least;
    const std::string wanted = fmt::format("a whole number in [{}, {}]", least, most);
    const Hdf5Handle found = attribute(object, name, H5T_INTEGER, wanted);
    if (!problem_ &&
        (H5Aread(found.id(), H5T_NATIVE_INT32, &value) < 0 || value < least || value > most)) {
      reject(fmt::format("attribute {}/{}", object, name), wanted, fmt::format("{}", value));
    }
    return problem_ ? least : value;
  }

  std::string text_attribute(const std::string& object, const char* name) {
    const Hdf5Handle found = attribute(object, name, H5T_STRING, "a text");
    if (problem_) {
      return {};
    }
    const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
    std::string value(H5Tget_size(type.id()), '\0');
    if (H5Aread(found.id(), type.id(), value.data()) < 0) {
      reject(fmt::format("attribute {}/{}", object, name), "a text", "what cannot be read");
    }
    return without_padding(std::move(value));
  }

  static std::string without_padding(std::string text) {
    text.resize(std::min(text.size(), text.find('\0')));
    return text;
  }

  Axis axis(const std::string& where) {
    Axis axis{.name = text_attribute(where, "name"),
              .first = number(where, "first"),
              .last = number(where, "last"),
              .points = whole(where, "points", 1, std::numeric_limits<std::int32_t>::max())};
    const std::string edge = text_attribute(where, "edge");
    const auto* const known = std::find_if(edge_names.begin(), edge_names.end(),
                                           [&](const auto& e) { return e.second == edge; });
    if (known != edge_names.end()) {
      axis.edge = known->first;
    } else {
      reject(fmt::format("attribute {}/edge", where), "open, periodic or mirrored", edge);
    }
    axis.stretch = number(where, "stretch");
    const std::int32_t turned = whole(where, "turned", -1, std::int32_t{max_dimensions} - 1);
    if (turned >= 0) {
      axis.turned = static_cast<std::size_t>(turned);
    }
    return axis;
  }

  void check(const Grid& grid) {
    if (problem_) {
      return;
    }
    if (const auto rule = broken_rule(grid)) {
      problem_ = Error{Error::Code::malformed, fmt::format("{}: grid: {}", source_, *rule)};
      return;
    }
    std::size_t cells = 1;
    for (const Axis& axis : grid.axes) {
      cells *= static_cast<std::size_t>(axis.points);  // each factor < 2^31: no overflow before
      if (cells > most_cells) {
        reject("grid", fmt::format("at most {} cells", most_cells), "more");
        return;
      }
    }
  }

  /// A data set that is there.
  Hdf5Handle data_set(const char* name) {
    Hdf5Handle set(problem_ ? H5I_INVALID_HID : H5Dopen2(file_.id(), name, H5P_DEFAULT), H5Dclose);
    if (!set.good()) {
      reject(fmt::format("data set {}", name), "one", "none");
    }
    return set;
  }

  std::string text(const char* name) {
    const Hdf5Handle set = data_set(name);
    if (problem_) {
      return {};
    }
    const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
    const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
    const bool right = H5Tget_class(type.id()) == H5T_STRING &&
                       H5Tis_variable_str(type.id()) == 0 &&
                       H5Sget_simple_extent_npoints(space.id()) == 1;
    std::string value(right ? H5Tget_size(type.id()) : 1, '\0');
    if (!right || H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) {
      reject(fmt::format("data set {}", name), "a text", "something else");
    }
    return without_padding(std::move(value));
  }

  static std::vector<hsize_t> shape(const Hdf5Handle& set) {
    const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
    if (rank > 0) {
      H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
    }
    return shape;
  }

  /// Whether the numbers of this shape can be in there: before memory is taken for them.
  template <class Real>
  void check(const Hdf5Handle& set, const char* name, const std::vector<hsize_t>& wanted) {
    const std::string part = fmt::format("data set {}", name);
    const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
    const std::vector<hsize_t> came = shape(set);
    if (came != wanted) {
      reject(part, fmt::format("{} numbers", fmt::join(wanted, " x ")),
             came.empty() ? "one value" : fmt::format("{}", fmt::join(came, " x ")));
    } else if (H5Tequal(type.id(), file_type<Real>()) <= 0) {
      reject(part, fmt::format("numbers of {} bytes", sizeof(Real)), "another type");
    } else {
      hsize_t kept = deflates_at_most * H5Dget_storage_size(set.id()) / sizeof(Real);
      for (const hsize_t extent : wanted) {
        kept /= extent;
      }
      if (kept == 0) {
        reject(part, fmt::format("{} numbers", fmt::join(wanted, " x ")), "fewer bytes");
      }
    }
  }

  template <class Real>
  void numbers(const char* name, const std::vector<hsize_t>& wanted,
               const std::vector<Real*>& rows) {
    const Hdf5Handle set = data_set(name);
    if (!problem_) {
      check<Real>(set, name, wanted);
    }
    if (problem_) {
      return;
    }
    const auto rank = static_cast<int>(wanted.size());
    std::vector<hsize_t> count = wanted;
    count[0] /= rows.size();
    const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
    const Hdf5Handle row_space(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
    std::vector<hsize_t> start(wanted.size(), 0);
    std::size_t size = 1;
    for (const hsize_t extent : count) {
      size *= extent;
    }
    for (Real* const row : rows) {
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
      if (H5Dread(set.id(), memory_type<Real>(), row_space.id(), space.id(), H5P_DEFAULT, row) <
          0) {
        reject(fmt::format("data set {}", name), "numbers", "what cannot be read");
        return;
      }
      const Real* const bad =
          std::find_if(row, row + size, [](Real x) { return !std::isfinite(x); });
      if (bad != row + size) {
        reject(fmt::format("data set {}", name), "finite numbers",
               fmt::format("{} at {}", *bad, bad - row));
        return;
      }
      start[0] += count[0];
    }
  }

  std::vector<double> times() {
    const Hdf5Handle set = data_set("times");
    if (problem_) {
      return {};
    }
    const std::vector<hsize_t> came = shape(set);
    if (came.size() != 1 || came[0] < 1) {
      reject("data set times", "a row of numbers", "another shape");
      return {};
    }
    check<double>(set, "times", came);
    std::vector<double> times(problem_ ? 0 : came[0]);
    numbers<double>("times", came, {times.data()});
    if (const auto wanted = wrong_times(times); wanted && !problem_) {
      reject("data set times", *wanted, fmt::format("{}", fmt::join(times, ", ")));
    }
    return times;
  }

  void values(Solved& solved) {
    const Hdf5Handle set = data_set("values");
    if (problem_) {
      return;
    }
    const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
    if (H5Tequal(type.id(), file_type<double>()) > 0) {
      solved.values = snapshots<double>(set, solved);
    } else {
      solved.values = snapshots<float>(set, solved);
    }
  }

  template <class Real>
  Snapshots<Real> snapshots(const Hdf5Handle& set, const Solved& solved) {
    const std::vector<hsize_t> wanted = shape_of(solved.grid, solved.times.size());
    check<Real>(set, "values", wanted);
    if (problem_) {
      return {};
    }
    Snapshots<Real> all(solved.times.size(), std::vector<Real>(num_cells(solved.grid)));
    std::vector<Real*> rows;
    for (std::vector<Real>& values : all) {
      rows.push_back(values.data());
    }
    numbers<Real>("values", wanted, rows);
    return all;
  }

  std::string source_;
  std::optional<Error> problem_;
  Hdf5Handle access_;
  Hdf5Handle file_;
};

/// Why the first 512 bytes are not what the rest calls for.
Error wrong_head(const std::string& source, std::string_view bytes) {
  const std::string wanted = fmt::format("{}: want a file of {}, got ", source, file_format);
  const auto told = [](const std::string& text) { return Error{Error::Code::malformed, text}; };
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  if (bytes.substr(0, hdf5_signature.size()) == hdf5_signature) {
    return told(wanted + "HDF5 of another kind");
  }
  if (line.substr(0, any_format.size()) != any_format || line.size() > 2 * file_format.size()) {
    return told(wanted + (bytes.empty() ? "an empty file" : "something else"));
  }
  if (line != file_format && bytes.size() > line.size()) {
    return told(wanted + std::string(line));
  }
  return told(wanted + fmt::format("one of {} bytes whose size or check sum is not what its first "
                                   "lines say: it is cut off or damaged",
                                   bytes.size()));
}

}  // namespace

std::vector<float> snapshot(const Solved& solved, std::size_t time) {
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

std::size_t nearest_snapshot(const Solved& solved, double time) {
  expects(!solved.times.empty(), "there is a snapshot");
  const auto nearest = std::min_element(
      solved.times.begin(), solved.times.end(),
      [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
  return static_cast<std::size_t>(nearest - solved.times.begin());
}

std::optional<Error> write_solved(const fs::path& path, const Solved& solved) {
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
  const std::optional<std::string> body = hdf5_part(solved);
  if (!body) {
    return Error{Error::Code::unwritable, path.string() + ": HDF5 cannot make the file in memory"};
  }
  return write_file(path, head_of(*body) + *body);
}

Result<Solved> read_solved(const fs::path& path) {
  const auto bytes = read_file(path);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  const std::string_view all = bytes.value();
  const std::string_view body = all.substr(std::min(head_size, all.size()));
  if (all.substr(0, head_size) != head_of(body)) {
    return wrong_head(path.string(), all);
  }
  try {
    const Hdf5Session session;
    ValueReader reader(path.string(), body);
    Solved solved = reader.read();
    if (reader.problem()) {
      return *reader.problem();
    }
    return solved;
  } catch (const std::exception& problem) {
    return Error{Error::Code::unreadable,
                 fmt::format("{}: cannot be read: {}", path.string(), problem.what())};
  }
}

}  // namespace saca::reach
