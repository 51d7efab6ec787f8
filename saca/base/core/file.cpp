#include "saca/base/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace saca {
namespace {

std::string reason() {
  return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): glibc's is thread-safe
}

// What is no file; empty: it is one.
std::string_view other_kind(mode_t mode) {
  return S_ISREG(mode)                    ? ""
         : S_ISDIR(mode)                  ? "a folder"
         : S_ISCHR(mode) || S_ISBLK(mode) ? "a device"
         : S_ISFIFO(mode)                 ? "a pipe"
                                          : "a socket";
}

// An open file, closed with this.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { (void)close(); }

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

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

bool write_parts(int file, std::initializer_list<std::string_view> parts) {
  return std::all_of(parts.begin(), parts.end(),
                     [file](std::string_view part) { return write_all(file, part); });
}

std::optional<Error> read(const std::filesystem::path& path, std::uintmax_t most,
                          const std::function<void(std::string_view)>& take) {
  const auto refuse = [&](const std::string& why) {
    return Error{Error::Code::unreadable, path.string() + ": " + why};
  };
  // Without waiting: nobody may ever write into a pipe.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat about {};
  if (file.number() < 0 || ::fstat(file.number(), &about) != 0) {
    return refuse("cannot be opened: " + reason());
  }
  if (const std::string_view kind = other_kind(about.st_mode); !kind.empty()) {
    return refuse("is " + std::string(kind) + ", want a file");
  }
  auto left = most;  // asked of what is read, too: a file may grow, and those of /proc tell no size
  std::string bytes(std::size_t{1} << 20U, '\0');
  const auto too_long = [&](std::uintmax_t got) {
    return refuse("want at most " + std::to_string(most) + " bytes, got " + std::to_string(got));
  };
  if (static_cast<std::uintmax_t>(about.st_size) > most) {
    return too_long(static_cast<std::uintmax_t>(about.st_size));
  }
  while (true) {
    const ssize_t count = ::read(file.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0) {
      return refuse("cannot be read: " + reason());
    }
    if (count == 0) {
      return std::nullopt;
    }
    const auto size = static_cast<std::size_t>(count);
    if (size > left) {
      return too_long(most - left + size);
    }
    left -= size;
    take(std::string_view(bytes).substr(0, size));
  }
}

std::optional<Error> write_into_device(const std::filesystem::path& path,
                                       std::initializer_list<std::string_view> parts) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (file.number() < 0 || !write_parts(file.number(), parts) || !file.close()) {
    return Error{Error::Code::unwritable, path.string() + ": cannot be written: " + reason()};
  }
  return std::nullopt;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::uintmax_t most) {
  std::string text;
  std::error_code unknown;
  if (const auto size = std::filesystem::file_size(path, unknown); !unknown && size <= most) {
    text.reserve(size);
  }
  if (auto problem = read(path, most, [&](std::string_view bytes) { text += bytes; })) {
    return *std::move(problem);
  }
  return text;
}

std::optional<Error> read_file(const std::filesystem::path& path,
                               const std::function<void(std::string_view)>& take) {
  return read(path, std::numeric_limits<std::uintmax_t>::max(), take);
}

std::optional<Error> write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path, {text});
}

std::optional<Error> write_file(const std::filesystem::path& path,
                                std::initializer_list<std::string_view> parts) {
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0) {
    if (S_ISCHR(about.st_mode)) {
      return write_into_device(path, parts);
    }
    if (const std::string_view kind = other_kind(about.st_mode); !kind.empty()) {
      return Error{Error::Code::unwritable,
                   path.string() + ": is " + std::string(kind) + ", want a file"};
    }
  }
  std::error_code no_link;
  const auto target = std::filesystem::is_symlink(path, no_link)
                          ? std::filesystem::weakly_canonical(path, no_link)
                          : path;
  std::string draft = target.string() + ".XXXXXX";
  Descriptor file(::mkstemp(draft.data()));
  if (file.number() < 0) {
    return Error{Error::Code::unwritable, path.string() + ": cannot be created: " + reason()};
  }
  constexpr mode_t readable_by_all = 0644;
  bool good = ::fchmod(file.number(), readable_by_all) == 0 && write_parts(file.number(), parts) &&
              ::fsync(file.number()) == 0;
  std::string why = good ? "" : reason();
  good = file.close() && good;
  if (good && ::rename(draft.c_str(), target.c_str()) == 0) {
    return std::nullopt;
  }
  if (why.empty()) {
    why = reason();
  }
  ::unlink(draft.c_str());
  return Error{Error::Code::unwritable, path.string() + ": cannot be written: " + why};
}

std::optional<Error> why_unwritable(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  struct stat about {};
  const bool there = ::stat(path.c_str(), &about) == 0;
  if (there && S_ISCHR(about.st_mode)) {
    const Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    return device.number() >= 0
               ? std::nullopt
               : std::optional(Error{Error::Code::unwritable,
                                     path.string() + ": cannot be written: " + reason()});
  }
  const std::string_view kind = there ? other_kind(about.st_mode) : "";
  if (!kind.empty()) {
    return Error{Error::Code::unwritable,
                 path.string() + ": is " + std::string(kind) + ", want a file"};
  }
  std::error_code problem;
  const fs::path target =
      fs::is_symlink(path, problem) ? fs::weakly_canonical(path, problem) : path;
  std::vector<fs::path> made;  // the innermost first
  for (fs::path folder = target.parent_path();
       !folder.empty() && !fs::exists(folder, problem) && folder != folder.parent_path();
       folder = folder.parent_path()) {
    made.push_back(folder);
  }
  problem.clear();
  if (!made.empty()) {
    fs::create_directories(made.front(), problem);
  }
  std::optional<Error> found;
  if (problem) {
    found = Error{Error::Code::unwritable,
                  target.parent_path().string() + ": cannot be made: " + problem.message()};
  } else {
    std::string draft = target.string() + ".XXXXXX";
    const Descriptor file(::mkstemp(draft.data()));
    if (file.number() < 0) {
      found = Error{Error::Code::unwritable, path.string() + ": cannot be created: " + reason()};
    } else {
      ::unlink(draft.c_str());
    }
  }
  for (const fs::path& folder : made) {
    fs::remove(folder, problem);  // but what somebody else has put something into meanwhile
  }
  return found;
}

}  // namespace saca
