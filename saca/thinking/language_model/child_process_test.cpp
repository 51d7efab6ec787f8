#include "saca/thinking/language_model/child_process.h"

#include <gtest/gtest.h>

namespace saca::language_model::child_process_test {
namespace {

using namespace std::chrono_literals;

// Time stands still: the process has as long as it takes. Behaviour against a deadline is tested
// with the whole conversation in child_model_test.cpp.
class StillClock final : public Clock {
 public:
  [[nodiscard]] Time now() const noexcept override { return Time(0); }
  void wait_until(Time) noexcept override {}
};

std::vector<std::string> shell(const std::string& script) {
  return {"/bin/sh", "-c", script};
}

TEST(ChildProcess, EchoesLineByLine) {
  StillClock clock;
  ChildProcess process(shell("cat"), clock);
  ASSERT_FALSE(process.start().has_value());
  ASSERT_FALSE(process.send("first", 1s).has_value());
  ASSERT_FALSE(process.send("second", 1s).has_value());
  EXPECT_EQ(process.receive(1s).value(), "first");
  EXPECT_EQ(process.receive(1s).value(), "second");
  EXPECT_TRUE(process.running());
}

TEST(ChildProcess, LongLinesArriveWhole) {
  StillClock clock;
  ChildProcess process(shell("cat"), clock);
  ASSERT_FALSE(process.start().has_value());
  const std::string line(100'000, 'x');  // more than one read, less than the connection holds
  ASSERT_FALSE(process.send(line, 1s).has_value());
  EXPECT_EQ(process.receive(1s).value(), line);
}

TEST(ChildProcess, WhatWasSaidBeforeTheEndIsHeard) {
  StillClock clock;
  ChildProcess process(shell("printf 'a\\nb\\nhalf'"), clock);
  ASSERT_FALSE(process.start().has_value());
  EXPECT_EQ(process.receive(1s).value(), "a");
  EXPECT_EQ(process.receive(1s).value(), "b");
  EXPECT_EQ(process.receive(1s).error().code, Error::Code::unreadable);
  EXPECT_FALSE(process.running());
}

TEST(ChildProcess, WritingToADeadProcessIsAnErrorNotASignal) {
  StillClock clock;
  ChildProcess process(shell("exit 0"), clock);
  ASSERT_FALSE(process.start().has_value());
  ASSERT_FALSE(process.receive(1s).has_value());
  EXPECT_EQ(process.send("line", 1s)->code, Error::Code::unreadable);
}

TEST(ChildProcess, NothingIsSaidBeforeStart) {
  StillClock clock;
  ChildProcess process(shell("cat"), clock);
  EXPECT_FALSE(process.running());
  EXPECT_EQ(process.send("line", 1s)->code, Error::Code::unreadable);
  EXPECT_EQ(process.receive(1s).error().code, Error::Code::unreadable);
}

TEST(ChildProcess, PassedDeadlineIsLate) {
  StillClock clock;
  ChildProcess process(shell("cat"), clock);
  ASSERT_FALSE(process.start().has_value());
  EXPECT_EQ(process.receive(0s).error().code, Error::Code::too_late);
}

TEST(ChildProcess, StartsAgainAfterKill) {
  StillClock clock;
  ChildProcess process(shell("echo hello; cat"), clock);
  for (int i = 0; i < 3; ++i) {
    ASSERT_FALSE(process.start().has_value());
    EXPECT_EQ(process.receive(1s).value(), "hello");  // nothing of the one before is heard
    process.kill();
    EXPECT_FALSE(process.running());
  }
}

TEST(ChildProcess, GetsNoSecretOfTheEnvironment) {
  const std::vector<const char*> secrets{"SACA_LLM_KEY", "a_token", "MY_PASSWORD"};
  for (const char* secret : secrets) {
    ASSERT_EQ(::setenv(secret, "sk-0123", 1), 0);
  }
  StillClock clock;
  ChildProcess process(shell("env"), clock);
  ASSERT_FALSE(process.start().has_value());
  std::string all;
  for (auto line = process.receive(1s); line.has_value(); line = process.receive(1s)) {
    all += line.value() + "\n";
  }
  for (const char* secret : secrets) {
    ::unsetenv(secret);
  }
  EXPECT_EQ(all.find("sk-0123"), std::string::npos);
  EXPECT_NE(all.find("PATH="), std::string::npos);
}

TEST(ChildProcess, IsRestrained) {
  StillClock clock;
  ChildProcess process(
      shell("read -r line; ulimit -c; ulimit -n; ulimit -f; cat /proc/self/oom_score_adj"), clock);
  ASSERT_FALSE(process.start().has_value());
  ASSERT_FALSE(process.send("now", 1s).has_value());  // when it has been done to it
  EXPECT_EQ(process.receive(1s).value(), "0");
  EXPECT_LE(std::stoi(process.receive(1s).value()), 1024);
  EXPECT_NE(process.receive(1s).value(), "unlimited");
  EXPECT_EQ(process.receive(1s).value(), "1000");
}

TEST(ChildProcess, EmptyCommandIsRefused) {
  StillClock clock;
  EXPECT_THROW(ChildProcess({}, clock), ContractViolation);
}

}  // namespace
}  // namespace saca::language_model::child_process_test
