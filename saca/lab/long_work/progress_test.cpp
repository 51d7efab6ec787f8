#include "saca/lab/long_work/progress.h"

#include <gtest/gtest.h>

namespace saca::long_work::progress_test {
namespace {

/// What stands on the error stream, which is no terminal here, after three of four steps.
std::string told(ProgressDisplay display) {
  ManualClock clock;
  testing::internal::CaptureStderr();
  {
    ProgressLine line("solve\nall", 4, clock, display);
    line.show(1, 0, " cells");
    clock.advance(std::chrono::seconds(7));
    line.show(3, 0, " cells");
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, IsOneLineAtTheEndWhereThereIsNoTerminal) {
  EXPECT_EQ(told(ProgressDisplay::shown), "solve all: 3 of at most 4 cells, 7 s\n");
}

TEST(Progress, IsNotToldWhereItIsUnwanted) {
  EXPECT_EQ(told(ProgressDisplay::silent), "");
}

TEST(Progress, IsNotToldOfWhatNeverBegan) {
  ManualClock clock;
  testing::internal::CaptureStderr();
  { const ProgressLine line("solve", 4, clock, ProgressDisplay::shown); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace saca::long_work::progress_test
