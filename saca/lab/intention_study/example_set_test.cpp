#include "saca/lab/intention_study/example_set.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "saca/lab/intention_study/recordings_for_test.h"
#include "saca/lab/intention_study/sets_for_test.h"
#include "saca/lab/recordings/set_file.h"

namespace saca::intention_study::example_set_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string set_file(const std::string& site) {
  const std::string file = testing::TempDir() + "example_set_test_" + site + ".h5";
  EXPECT_EQ(recordings::write_set(file, recorded_at(site, recorded_vehicle(100, 0.0))),
            std::nullopt);
  return file;
}

TEST(Examples, AreRecordedOnesInPartsAndSimulatedOnesOfTwoSeeds) {
  const auto made = example_set(
      {.sets = {set_file("x"), set_file("y")}, .parts = 2, .simulated = 4, .seed = 5}, 2);
  ASSERT_TRUE(made.has_value()) << made.error().message;
  const intention_scoring::SequenceSet& set = made.value();
  EXPECT_EQ(intention_scoring::broken_rule(set), std::nullopt);
  ASSERT_EQ(set.sequences.size(), 2U + 4U + 2U);
  EXPECT_EQ(set.sequences[0].site, "x");
  EXPECT_EQ(set.sequences[1].site, "y");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(set.sequences[i].simulated);
    EXPECT_THAT(set.splits[i], testing::AnyOf("part-0", "part-1"));
  }
  EXPECT_EQ(std::count(set.splits.begin(), set.splits.end(), "simulated"), 4);
  EXPECT_EQ(std::count(set.splits.begin(), set.splits.end(), "test"), 2);
  EXPECT_THAT(set.sequences[2].name, StartsWith("simulated "));
  EXPECT_THAT(set.sequences[6].name, StartsWith("test "));
  EXPECT_NE(set.sequences[2].observations[0].speed,
            set.sequences[6].observations[0].speed);  // of another seed
}

TEST(Examples, OfAFileThatIsNoneAreRefused) {
  EXPECT_THAT(example_set({.sets = {"nowhere.h5"}}, 1).error().message, HasSubstr("nowhere.h5"));
}

TEST(Shares, CountSequencesGroupsHoursAndFramesOfEachSplit) {
  intention_scoring::SequenceSet set = small_set();
  set.splits = {"part-0", "part-0", "simulated", "test"};
  set.sequences[1].scored[0] = false;
  set.sequences[1].group = set.sequences[0].group;
  const std::string text = shares_text(set);
  EXPECT_THAT(text, StartsWith("split        sequences   groups    hours | frames: M, LC, RC, FB, "
                               "LB, RB; in doubt\n"));
  // 80 frames of 0.1 s, one in doubt.
  EXPECT_THAT(text, HasSubstr("\npart-0               2        1     0.00 | 59 0 0 20 0 0; 1\n"));
  EXPECT_THAT(text, HasSubstr("\nsimulated            1        1     0.00 | 0 0 0 0 20 0; 0\n"));
  EXPECT_THAT(text, HasSubstr("\ntest                 1        1     0.00 | 40 0 0 0 0 20; 0\n"));
}

TEST(Shares, TellHoursOfFrames) {
  intention_scoring::SequenceSet set{
      .sequences = {recorded_sequence("a", "b", std::string(3'600, 'M'))}, .splits = {"x"}};
  EXPECT_THAT(shares_text(set), HasSubstr("     0.10 | 3600 "));  // 6 min
}

}  // namespace
}  // namespace saca::intention_study::example_set_test
