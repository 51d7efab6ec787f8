#include "saca/lab/verification/npz.h"

#include <fmt/core.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "saca/base/core/file.h"

namespace saca::verification {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20U;
constexpr int most_entries = 256;

Error malformed(const std::string& source, const std::string& what) {
  return {Error::Code::malformed, source + ": " + what};
}

/// `text` for a message: no more than a few printable characters.
std::string shown(std::string_view text) {
  std::string all;
  for (const char c : text.substr(0, 40)) {
    all += c >= ' ' && c <= '~' ? c : '?';
  }
  return "'" + all + "'";
}

/// Reads a Python literal from left to right.
class Literal {
 public:
  explicit Literal(std::string_view text) : text_(text) {}

  /// Steps over white space and then `wanted`, if that comes next.
  bool accept(std::string_view wanted) {
    skip_spaces();
    if (!rest().starts_with(wanted)) {
      return false;
    }
    at_ += wanted.size();
    return true;
  }
  std::optional<std::string> quoted() {
    skip_spaces();
    if (rest().empty() || (rest().front() != '\'' && rest().front() != '"')) {
      return std::nullopt;
    }
    const std::size_t end = text_.find(rest().front(), at_ + 1);
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    std::string inside(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return inside;
  }
  std::optional<std::size_t> number() {
    skip_spaces();
    std::size_t value = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (problem != std::errc()) {
      return std::nullopt;
    }
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  [[nodiscard]] bool at_end() {
    skip_spaces();
    return rest().empty();
  }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) {
      ++at_;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

struct NpyHeader {
  std::optional<std::string> type;
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::size_t>> shape;
};

std::optional<std::vector<std::size_t>> parse_shape(Literal& literal) {
  std::vector<std::size_t> shape;
  if (!literal.accept("(")) {
    return std::nullopt;
  }
  while (!literal.accept(")")) {
    const auto extent = literal.number();
    if (!extent) {
      return std::nullopt;
    }
    shape.push_back(*extent);
    if (!literal.accept(",")) {
      // "(3)" is no tuple
      return shape.size() > 1 && literal.accept(")") ? std::optional(shape) : std::nullopt;
    }
  }
  return shape;
}

/// The value that belongs to `key`; false: it is not what it should be, or was there before.
bool parse_entry(const std::string& key, Literal& literal, NpyHeader& header) {
  if (key == "descr" && !header.type) {
    header.type = literal.quoted();
    return header.type.has_value();
  }
  if (key == "fortran_order" && !header.fortran_order) {
    const bool is_true = literal.accept("True");
    header.fortran_order = is_true;
    return is_true || literal.accept("False");
  }
  if (key == "shape" && !header.shape) {
    header.shape = parse_shape(literal);
    return header.shape.has_value();
  }
  return false;
}

/// {'descr': '<f4', 'fortran_order': False, 'shape': (4, 256), }; nullopt: it is not of that kind.
std::optional<NpyHeader> parse_header(std::string_view text) {
  Literal literal(text);
  NpyHeader header;
  if (!literal.accept("{")) {
    return std::nullopt;
  }
  while (!literal.accept("}")) {
    const auto key = literal.quoted();
    if (!key || !literal.accept(":") || !parse_entry(*key, literal, header)) {
      return std::nullopt;
    }
    if (!literal.accept(",") && !literal.rest().starts_with('}')) {
      return std::nullopt;
    }
  }
  const bool whole = header.type && header.fortran_order && header.shape && literal.at_end();
  return whole ? std::optional(header) : std::nullopt;
}

/// Product of all; nullopt: more than a file may have.
std::optional<std::size_t> num_values(const std::vector<std::size_t>& shape) {
  std::size_t total = 1;
  for (const std::size_t extent : shape) {
    if (extent == 0) {
      return 0;
    }
    if (total > most_bytes / extent) {
      return std::nullopt;
    }
    total *= extent;
  }
  return total;
}

std::size_t little_endian(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    value = value << 8U | static_cast<std::uint8_t>(bytes[i]);
  }
  return value;
}

template <class Real>
double number_at(std::string_view data, std::size_t i) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  Real value = 0;
  std::memcpy(&value, data.data() + i * sizeof(Real), sizeof(Real));
  return static_cast<double>(value);
}

/// Number in the file of the row-major `i`, when the first index runs fastest there.
std::size_t fortran_place(std::size_t i, const std::vector<std::size_t>& shape) {
  std::size_t place = 0;
  std::size_t total = 1;
  for (const std::size_t extent : shape) {
    total *= extent;
  }
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    total /= shape[axis];
    place += i % shape[axis] * total;
    i /= shape[axis];
  }
  return place;
}

Result<NpyArray> array_of(const NpyHeader& header, std::string_view data,
                          const std::string& source) {
  if (*header.type != "<f4" && *header.type != "<f8") {
    return malformed(source, "want numbers of type '<f4' or '<f8', got " + shown(*header.type));
  }
  const bool singles = *header.type == "<f4";
  const auto count = num_values(*header.shape);
  if (!count || data.size() != *count * (singles ? 4 : 8)) {
    return malformed(source, fmt::format("want {} numbers of {} bytes, got {} bytes",
                                         count ? fmt::format("{}", *count) : std::string("fewer"),
                                         singles ? 4 : 8, data.size()));
  }
  NpyArray array{*header.shape, std::vector<double>(*count)};
  for (std::size_t i = 0; i < *count; ++i) {
    const std::size_t place = *header.fortran_order ? fortran_place(i, array.shape) : i;
    array.values[i] = singles ? number_at<float>(data, place) : number_at<double>(data, place);
    if (!std::isfinite(array.values[i])) {
      return malformed(source,
                       fmt::format("want finite numbers, got {} as number {}", array.values[i], i));
    }
  }
  return array;
}

struct CloseZip {
  void operator()(zip_t* zip) const { zip_discard(zip); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

std::string text_of(zip_error_t& problem) {
  std::string text = zip_error_strerror(&problem);
  zip_error_fini(&problem);
  return text;
}

/// The archive that lies in `bytes`, which must outlive it.
Result<std::unique_ptr<zip_t, CloseZip>> opened(std::string_view bytes, const std::string& source) {
  zip_error_t problem;
  zip_error_init(&problem);
  zip_source_t* const buffer = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &problem);
  if (buffer == nullptr) {
    return malformed(source, "want an .npz (zip) file: " + text_of(problem));
  }
  zip_t* const archive = zip_open_from_source(buffer, ZIP_RDONLY | ZIP_CHECKCONS, &problem);
  if (archive == nullptr) {
    zip_source_free(buffer);
    return malformed(source, "want an .npz (zip) file: " + text_of(problem));
  }
  zip_error_fini(&problem);
  return std::unique_ptr<zip_t, CloseZip>(archive);
}

struct ZipEntry {
  std::string name, bytes;
};

Result<ZipEntry> read_entry(zip_t* archive, zip_int64_t number, const std::string& source) {
  zip_stat_t about;
  const auto index = static_cast<zip_uint64_t>(number);
  if (zip_stat_index(archive, index, 0, &about) != 0 ||
      (about.valid & (ZIP_STAT_NAME | ZIP_STAT_SIZE)) != (ZIP_STAT_NAME | ZIP_STAT_SIZE)) {
    return malformed(source, fmt::format("entry {} has no name or size", number));
  }
  const std::string place = source + ": " + shown(about.name);
  if (about.size > most_bytes) {
    return malformed(place, fmt::format("want at most {} bytes, got {}", most_bytes, about.size));
  }
  const std::unique_ptr<zip_file_t, CloseEntry> entry(zip_fopen_index(archive, index, 0));
  if (entry == nullptr) {
    return malformed(place, std::string("cannot be read: ") + zip_strerror(archive));
  }
  ZipEntry all{about.name, std::string(about.size, '\0')};
  const zip_int64_t came = zip_fread(entry.get(), all.bytes.data(), about.size);
  char beyond = 0;  // to read on to the end has the sum checked
  if (came < 0 || static_cast<zip_uint64_t>(came) != about.size ||
      zip_fread(entry.get(), &beyond, 1) != 0) {
    return malformed(place, fmt::format("want {} bytes with the right sum, got {}: {}", about.size,
                                        came, zip_file_strerror(entry.get())));
  }
  return all;
}

}  // namespace

Result<NpyArray> parse_npy(std::string_view bytes, const std::string& source) {
  constexpr std::string_view magic = "\x93NUMPY";
  constexpr std::size_t before_length = magic.size() + 2;
  if (!bytes.starts_with(magic) || bytes.size() < before_length) {
    return malformed(source, "want a .npy file, got one that begins " + shown(bytes.substr(0, 8)));
  }
  const int version = static_cast<std::uint8_t>(bytes[magic.size()]);
  if (version < 1 || version > 3 || bytes[magic.size() + 1] != 0) {
    return malformed(source, fmt::format("want version 1.0 to 3.0 of .npy, got {}.{}", version,
                                         static_cast<std::uint8_t>(bytes[magic.size() + 1])));
  }
  const std::size_t length_size = version == 1 ? 2 : 4;
  const std::size_t begin = before_length + length_size;
  const std::size_t length =
      bytes.size() < begin ? bytes.size() : little_endian(bytes.substr(before_length, length_size));
  if (bytes.size() < begin || length > bytes.size() - begin) {
    return malformed(source, fmt::format("ends within its header, after {} bytes", bytes.size()));
  }
  const auto header = parse_header(bytes.substr(begin, length));
  if (!header) {
    return malformed(source, "want a header of descr, fortran_order and shape, got " +
                                 shown(bytes.substr(begin, length)));
  }
  return array_of(*header, bytes.substr(begin + length), source);
}

Result<std::map<std::string, NpyArray>> parse_npz(std::string_view bytes,
                                                  const std::string& source) {
  const auto archive = opened(bytes, source);
  if (!archive.has_value()) {
    return archive.error();
  }
  const zip_int64_t count = zip_get_num_entries(archive.value().get(), 0);
  if (count < 1 || count > most_entries) {
    return malformed(source, fmt::format("want 1 to {} entries, got {}", most_entries, count));
  }
  std::map<std::string, NpyArray> arrays;
  for (zip_int64_t number = 0; number < count; ++number) {
    const auto entry = read_entry(archive.value().get(), number, source);
    if (!entry.has_value()) {
      return entry.error();
    }
    const std::string& name = entry.value().name;
    constexpr std::string_view ending = ".npy";
    if (!name.ends_with(ending)) {
      return malformed(source, "want entries that end in .npy, got " + shown(name));
    }
    auto array = parse_npy(entry.value().bytes, source + ": " + shown(name));
    if (!array.has_value()) {
      return array.error();
    }
    arrays.emplace(name.substr(0, name.size() - ending.size()), std::move(array).value());
  }
  return arrays;
}

Result<std::map<std::string, NpyArray>> read_npz(const std::filesystem::path& path) {
  std::error_code unknown_size;
  const auto size = std::filesystem::file_size(path, unknown_size);
  if (!unknown_size && size > most_bytes) {
    return malformed(path.string(), fmt::format("want at most {} bytes, got {}", most_bytes, size));
  }
  const auto bytes = read_file(path, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  return parse_npz(bytes.value(), path.string());
}

}  // namespace saca::verification
