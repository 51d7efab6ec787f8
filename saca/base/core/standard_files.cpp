#include "saca/base/core/standard_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <initializer_list>

namespace saca {

void occupy_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) < 0) {
      (void)::open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

}  // namespace saca
