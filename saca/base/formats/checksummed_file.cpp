#include "saca/base/formats/checksummed_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"

namespace saca::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t head_size = 512;  // a user block, which HDF5 wants to be of such a size
constexpr std::size_t longest_format = 64;

/// What a file begins with, and what that is to say of the rest.
struct Outline {
  std::string head;      // 512 bytes, or as many as there are
  std::size_t size = 0;  // of the rest
  Fnv sum;               // likewise
};

Result<Outline> outline_of(const fs::path& path) {
  Outline outline;
  const auto problem = read_file(path, [&](std::string_view bytes) {
    const std::size_t of_head = std::min(bytes.size(), head_size - outline.head.size());
    outline.head += bytes.substr(0, of_head);
    outline.sum.add(bytes.substr(of_head));
    outline.size += bytes.size() - of_head;
  });
  if (problem) {
    return *problem;
  }
  return outline;
}

/// The first 512 bytes: format, size and check sum of what follows.
std::string head_for(std::string_view format, const Outline& rest) {
  std::string head =
      fmt::format("{}\nbytes {}\nfnv1a {:016x}\n", format, rest.size, rest.sum.value());
  head.resize(head_size, '\0');
  return head;
}

/// The name and the slash: what all versions begin with.
std::string_view any_version(std::string_view format) {
  return format.substr(0, format.find('/') + 1);
}

/// Why the first 512 bytes are not what the rest calls for.
Error wrong_head(const std::string& source, std::string_view format, const Outline& outline) {
  const std::string wanted = fmt::format("{}: want a file of {}, got ", source, format);
  const auto told = [](const std::string& text) { return Error{Error::Code::malformed, text}; };
  const std::string_view head = outline.head;
  const std::string_view line = head.substr(0, head.find('\n'));
  const std::string_view any = any_version(format);
  if (head.substr(0, hdf5_signature.size()) == hdf5_signature) {
    return told(wanted + "HDF5 of another kind");
  }
  if (line.substr(0, any.size()) != any || line.size() > 2 * format.size()) {
    return told(wanted + (head.empty() ? "an empty file" : "something else"));
  }
  if (line != format && head.size() > line.size()) {
    return told(wanted + std::string(line));
  }
  return told(wanted + fmt::format("one of {} bytes whose size or check sum is not what its first "
                                   "lines say: it is cut off or damaged",
                                   head.size() + outline.size));
}

void check_format(std::string_view format) {
  expects(format.find('/') != std::string_view::npos && format.size() <= longest_format,
          "format is a name, a slash and a version");
}

}  // namespace

std::optional<Error> write_checksummed(const fs::path& path, std::string_view format,
                                       std::string_view body) {
  check_format(format);
  Outline outline{.head = {}, .size = body.size(), .sum = {}};
  outline.sum.add(body);
  return write_file(path, {head_for(format, outline), body});
}

std::optional<Error> verify_checksum(const fs::path& path, std::string_view format) {
  check_format(format);
  const auto outline = outline_of(path);
  if (!outline.has_value()) {
    return outline.error();
  }
  if (outline.value().head != head_for(format, outline.value())) {
    return wrong_head(path.string(), format, outline.value());
  }
  return std::nullopt;
}

}  // namespace saca::formats
