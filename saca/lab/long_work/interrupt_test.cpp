#include "saca/lab/long_work/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace saca::long_work::interrupt_test {
namespace {

/// What has been asked to stop stays so: each signal gets a process of its own.
void end_well_if(bool true_of_it) {
  std::_Exit(true_of_it ? EXIT_SUCCESS : EXIT_FAILURE);
}

TEST(InterruptDeathTest, IsRememberedOfBothSignalsThatEndAProgram) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          watch_for_interrupt();
          const bool before = interrupted();
          (void)std::raise(signal);
          end_well_if(!before && interrupted());
        },
        testing::ExitedWithCode(EXIT_SUCCESS), "");
  }
}

TEST(InterruptDeathTest, EndsTheProcessAsLongAsNobodyWatches) {
  EXPECT_EXIT((void)std::raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
}

TEST(InterruptDeathTest, AsksForAStop) {
  EXPECT_EXIT(
      {
        watch_for_interrupt();
        const InterruptStop stop;
        const bool before = stop.token().stop_requested();
        (void)std::raise(SIGINT);
        while (!stop.token().stop_requested()) {
          std::this_thread::yield();
        }
        end_well_if(!before);
      },
      testing::ExitedWithCode(EXIT_SUCCESS), "");
}

TEST(Interrupt, NoStopIsAskedForWithoutOne) {
  std::stop_token token;
  {
    const InterruptStop stop;
    token = stop.token();
  }
  EXPECT_FALSE(token.stop_requested());
}

}  // namespace
}  // namespace saca::long_work::interrupt_test
