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

TEST(Invocation, IsAsAShellWouldTakeItAgain) {
  const std::string words("./saca\0run\0my scenario.toml\0--json\0", 35);
  EXPECT_EQ(invocation_of(words), "saca run 'my scenario.toml' --json");
  EXPECT_EQ(invocation_of(std::string("./saca\0", 7)), "saca");
  EXPECT_EQ(invocation_of(""), "saca");
  EXPECT_THAT(invocation(), StartsWith("saca"));  // of this very process
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
    before == nullptr ? ::unsetenv("NO_COLOR") : ::setenv("NO_COLOR", kept.c_str(), 1);
    ::close(terminal);
  }
}

TEST(Now, IsIso8601InUtc) {
  EXPECT_THAT(now_in_utc(),
              MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z"));
}

}  // namespace
}  // namespace saca::shell::invocation_test
