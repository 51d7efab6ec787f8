#include "saca/lab/long_work/folder_hold.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace saca::long_work {

FolderHold::FolderHold(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}

bool FolderHold::holds_at_once() const {
  return folder_ < 0 || ::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

FolderHold::FolderHold(const std::filesystem::path& folder, const std::function<void()>& waits)
    : FolderHold(folder) {
  if (holds_at_once()) {
    return;
  }
  waits();
  while (::flock(folder_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

std::optional<FolderHold> FolderHold::unless_held(const std::filesystem::path& folder) {
  FolderHold hold(folder);
  return hold.holds_at_once() ? std::optional(std::move(hold)) : std::nullopt;
}

FolderHold::FolderHold(FolderHold&& other) noexcept : folder_(std::exchange(other.folder_, -1)) {}

FolderHold::~FolderHold() {
  if (folder_ >= 0) {
    ::close(folder_);
  }
}

}  // namespace saca::long_work
