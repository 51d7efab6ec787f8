#include "saca/lab/reach_study/folder_hold.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace saca::reach_study {

FolderHold::FolderHold(const std::filesystem::path& folder, const std::function<void()>& waits)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0 || ::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
    return;
  }
  waits();
  while (::flock(folder_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

FolderHold::~FolderHold() {
  if (folder_ >= 0) {
    ::close(folder_);
  }
}

}  // namespace saca::reach_study
