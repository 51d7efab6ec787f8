#include "saca/lab/shell/invocation.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace saca::shell::invocation_test {
namespace {

using testing::MatchesRegex;
using testing::StartsWith;

// Of this very process, whose program is called otherwise.
TEST(Invocation, BeginsWithTheProgramsName) {
  EXPECT_THAT(invocation(), StartsWith("saca"));
  for (const std::string& word : testing::internal::GetArgvs()) {
    if (word.starts_with("--gtest_brief")) {
      EXPECT_THAT(invocation(), testing::HasSubstr(" " + word));
    }
  }
}

TEST(Colours, AreForTerminalsThatWantThem) {
  const int file = ::open("/dev/null", O_WRONLY);
  EXPECT_FALSE(wants_colours(file));
  ::close(file);
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal >= 0) {
    const char* const before = std::getenv("NO_COLOR");
    const std::string kept = before == nullptr ? "" : before;
    ::unsetenv("NO_COLOR");
    EXPECT_TRUE(wants_colours(terminal));
    ::setenv("NO_COLOR", "1", 1);
    EXPECT_FALSE(wants_colours(terminal));
    ::setenv("NO_COLOR", kept.c_str(), 1);
    ::close(terminal);
  }
}

TEST(Now, IsIso8601InUtc) {
  EXPECT_THAT(now_in_utc(),
              MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z"));
}

}  // namespace
}  // namespace saca::shell::invocation_test
