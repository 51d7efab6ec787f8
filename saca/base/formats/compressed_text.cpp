#include "saca/base/formats/compressed_text.h"

#include <zlib.h>

#include <array>
#include <climits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "saca/base/core/file.h"

namespace saca::formats {
namespace {

using Inflating = std::unique_ptr<z_stream, int (*)(z_stream*)>;

/// @return  what is wrong
std::optional<std::string> inflate_all(std::string_view bytes, std::size_t most,
                                       std::string& text) {
  z_stream stream{};
  constexpr int of_gzip = 16 + MAX_WBITS;
  if (bytes.size() > UINT_MAX || inflateInit2(&stream, of_gzip) != Z_OK) {
    return "cannot be read: want less than 4 GiB, and memory";
  }
  const Inflating until_end(&stream, inflateEnd);
  // zlib reads only, but its interface is older than const.
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));  // NOLINT
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::array<Bytef, std::size_t{1} << 16U> part;
  int code = Z_OK;
  while (code == Z_OK) {
    stream.next_out = part.data();
    stream.avail_out = static_cast<uInt>(part.size());
    code = inflate(&stream, Z_NO_FLUSH);
    text.append(part.data(), part.data() + (part.size() - stream.avail_out));
    if (text.size() > most) {
      return "want at most " + std::to_string(most) + " bytes of text, got more";
    }
  }
  if (code != Z_STREAM_END) {
    return std::string("is damaged: ") + (stream.msg != nullptr ? stream.msg : "ends too soon");
  }
  return stream.avail_in == 0 ? std::nullopt
                              : std::optional<std::string>("is damaged: goes on after its end");
}

}  // namespace

Result<std::string> read_compressed(const std::filesystem::path& file, std::size_t most) {
  auto bytes = read_file(file, most);
  constexpr std::string_view magic = "\x1f\x8b";
  if (!bytes.has_value() || !bytes.value().starts_with(magic)) {
    return bytes;
  }
  std::string text;
  if (auto problem = inflate_all(bytes.value(), most, text)) {
    return Error{Error::Code::malformed, file.string() + ": " + *std::move(problem)};
  }
  return text;
}

}  // namespace saca::formats
