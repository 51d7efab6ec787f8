#include "saca/base/core/standard_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace saca::standard_files_test {
namespace {

// In a process of its own, without these three: 0 where none of them can be written to as output or
// read as input, and a file that is opened takes the place of none.
int exit_code_without_standard_files() {
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int file : {0, 1, 2}) {
      ::close(file);
    }
    occupy_standard_files();
    char byte = 0;
    const bool shut = ::read(0, &byte, 1) < 0 && ::write(1, "x", 1) < 0 && ::write(2, "x", 1) < 0;
    const bool apart = ::open("/dev/zero", O_RDONLY) > 2;
    ::_exit(shut && apart ? 0 : 1);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StandardFiles, ThatAreClosedAreTakenByNoOtherFile) {
  EXPECT_EQ(exit_code_without_standard_files(), 0);
}

TEST(StandardFiles, ThatAreOpenStayAsTheyAre) {
  const int before = ::dup(0);
  occupy_standard_files();
  const int after = ::dup(0);
  EXPECT_EQ(after, before + 1);  // nothing else was opened
  ::close(after);
  ::close(before);
}

}  // namespace
}  // namespace saca::standard_files_test
