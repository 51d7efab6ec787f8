#include "thread_choice.h"

#include <gtest/gtest.h>

namespace saca::model_host::thread_choice_test {
namespace {

constexpr double disturbed = 0.6;

// Measured on two cores with the BF16 weights: a token of a prompt takes 0.8 ms, of a reply 9 ms;
// one thread takes 1.5 and 13 ms, whether or not somebody else holds the other core; two threads
// then take 1.8 and 60 ms.
TEST(ThreadChoice, StepsOfBothThreadsOnABusyMachineAreLeftToOne) {
  ThreadChoice choice(2, true);
  choice.take_one();
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_FALSE(choice.note_step(1, 0.013, disturbed));
  choice.take_all();
  EXPECT_FALSE(choice.note_step(1, 0.009, disturbed));
  EXPECT_EQ(choice.threads(), 2);
  EXPECT_FALSE(choice.note_step(1, 0.060, disturbed));  // once is nothing
  EXPECT_TRUE(choice.note_step(1, 0.060, disturbed));
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_EQ(choice.step_alone(1), 0.013);
  choice.take_all();
  EXPECT_EQ(choice.threads(), 2);
}

TEST(ThreadChoice, SlowStepsNowAndThenAreMadeUpFor) {
  ThreadChoice choice(2, true);
  choice.take_one();
  choice.note_step(1, 0.013, disturbed);
  choice.take_all();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(choice.note_step(1, i % 10 == 0 ? 0.040 : 0.009, disturbed)) << i;
  }
  EXPECT_TRUE(choice.note_step(1, 0.200, disturbed));  // at once where it is very slow
}

// On an Intel Xeon a step takes two threads as long as one now and then, though nobody disturbs.
TEST(ThreadChoice, StepsThatAreSlowThoughNobodyDisturbsAreMadeByAll) {
  ThreadChoice choice(2, true);
  choice.take_one();
  choice.note_step(1, 0.013, 1.0);
  choice.take_all();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(choice.note_step(1, 0.060, 0.87)) << i;
  }
  EXPECT_FALSE(choice.note_step(1, 0.060, 0.5));
  EXPECT_TRUE(choice.note_step(1, 0.060, 0.5)) << "from now on somebody does";
}

TEST(ThreadChoice, FreeCoresTellItBeforehand) {
  ThreadChoice choice(2, true);
  choice.note_free(1.1);
  EXPECT_EQ(choice.threads(), 1);
  choice.note_free(1.9);
  EXPECT_EQ(choice.threads(), 2);
  ThreadChoice stubborn(2, false);
  stubborn.note_free(0.0);
  EXPECT_EQ(stubborn.threads(), 2);
  ThreadChoice only(1, true);
  only.note_free(0.2);
  EXPECT_EQ(only.threads(), 1);
}

// Else what one thread takes would never be known.
TEST(ThreadChoice, FreeCoresDoNotEndARehearsalOfOneThread) {
  ThreadChoice choice(2, true);
  choice.take_one();
  choice.note_free(2.0);
  EXPECT_EQ(choice.threads(), 1);
  choice.note_step(1, 0.013, 1.0);
  EXPECT_EQ(choice.step_alone(1), 0.013);
  choice.take_all();
  choice.note_free(1.0);
  EXPECT_EQ(choice.threads(), 1);
  choice.note_free(2.0);
  EXPECT_EQ(choice.threads(), 2);
}

TEST(ThreadChoice, PromptTellsIt) {
  ThreadChoice choice(2, true);
  choice.note_prompt(0.0011, disturbed);  // cold
  EXPECT_EQ(choice.threads(), 2);
  choice.note_prompt(0.0008, 1.0);
  EXPECT_EQ(choice.threads(), 2);
  choice.note_prompt(0.0012, disturbed);
  EXPECT_EQ(choice.threads(), 2);
  choice.note_prompt(0.0018, disturbed);
  EXPECT_EQ(choice.threads(), 1);
  choice.note_prompt(0.0005, disturbed);  // of one thread: says nothing of both
  choice.take_all();
  choice.note_prompt(0.0008, disturbed);
  EXPECT_EQ(choice.threads(), 2);
}

// A cold cache, a lower clock, a longer context: nobody else has the cores.
TEST(ThreadChoice, PromptThatIsSlowThoughNobodyDisturbsIsReadByAll) {
  ThreadChoice choice(2, true);
  choice.note_prompt(0.0008, 1.0);
  choice.note_prompt(0.0100, 0.97);
  EXPECT_EQ(choice.threads(), 2);
  choice.note_prompt(0.0100, 0.70);
  EXPECT_EQ(choice.threads(), 1);
}

TEST(ThreadChoice, NumberOfScenesIsKeptApart) {
  ThreadChoice choice(2, true);
  choice.take_one();
  choice.note_step(3, 0.027, disturbed);
  choice.note_step(1, 0.013, disturbed);
  choice.take_all();
  EXPECT_FALSE(choice.note_step(2, 10.0, disturbed));   // nothing to compare with
  EXPECT_FALSE(choice.note_step(3, 0.120, disturbed));  // four steps lost of three scenes
  choice.take_all();
  EXPECT_TRUE(choice.note_step(1, 0.120, disturbed));
}

TEST(ThreadChoice, WhoDoesNotGiveWayOrHasOneThreadNeverChanges) {
  for (ThreadChoice choice : {ThreadChoice(2, false), ThreadChoice(1, true)}) {
    const int all = choice.threads();
    choice.take_one();
    EXPECT_EQ(choice.threads(), all);
    choice.note_step(1, 0.01, disturbed);
    choice.note_prompt(0.001, 0.5);
    EXPECT_FALSE(choice.note_step(1, 1.0, disturbed));
    choice.note_prompt(1.0, 0.5);
    EXPECT_EQ(choice.threads(), all);
  }
}

}  // namespace
}  // namespace saca::model_host::thread_choice_test
