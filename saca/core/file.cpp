#include "saca/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace saca {
namespace {

std::string reason() {
  return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): glibc's is thread-safe
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  std::string text;
  if (auto problem = read_file(path, [&](std::string_view bytes) { text += bytes; })) {
    return *std::move(problem);
  }
  return text;
}

std::optional<Error> read_file(const std::filesystem::path& path,
                               const std::function<void(std::string_view)>& take) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem)) {
    return Error{Error::Code::unreadable, path.string() + ": is a folder, want a file"};
  }
  if (std::filesystem::is_character_file(path, problem)) {  // it may never end
    return Error{Error::Code::unreadable, path.string() + ": is a device, want a file"};
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Error{Error::Code::unreadable, path.string() + ": cannot be opened: " + reason()};
  }
  std::string bytes(std::size_t{1} << 20, '\0');
  while (file) {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    take(std::string_view(bytes).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  if (file.bad()) {
    return Error{Error::Code::unreadable, path.string() + ": cannot be read: " + reason()};
  }
  return std::nullopt;
}

std::optional<Error> write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path, {text});
}

std::optional<Error> write_file(const std::filesystem::path& path,
                                std::initializer_list<std::string_view> parts) {
  std::string draft = path.string() + ".XXXXXX";
  const int file = ::mkstemp(draft.data());
  if (file < 0) {
    return Error{Error::Code::unwritable, path.string() + ": cannot be created: " + reason()};
  }
  constexpr mode_t readable_by_all = 0644;
  bool good = ::fchmod(file, readable_by_all) == 0 &&
              std::all_of(parts.begin(), parts.end(),
                          [file](std::string_view part) { return write_all(file, part); }) &&
              ::fsync(file) == 0;
  std::string why = good ? "" : reason();
  good = ::close(file) == 0 && good;
  if (good && ::rename(draft.c_str(), path.c_str()) == 0) {
    return std::nullopt;
  }
  if (why.empty()) {
    why = reason();
  }
  ::unlink(draft.c_str());
  return Error{Error::Code::unwritable, path.string() + ": cannot be written: " + why};
}

}  // namespace saca
