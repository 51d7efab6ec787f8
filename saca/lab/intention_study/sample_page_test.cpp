#include "saca/lab/intention_study/sample_page.h"

#include <gmock/gmock.h>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_study/sets_for_test.h"

namespace saca::intention_study::sample_page_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Eight vehicles that maintain, two that brake.
intention_scoring::SequenceSet ten() {
  intention_scoring::SequenceSet set;
  for (int i = 0; i < 10; ++i) {
    set.sequences.push_back(recorded_sequence(std::to_string(i), "here", i < 8 ? "MMMM" : "MMBB"));
    set.splits.emplace_back("part-0");
  }
  return set;
}

TEST(Samples, AreOfEachClassInTurn) {
  const auto chosen = drawn_samples(ten(), {.samples = 4});
  ASSERT_EQ(chosen.size(), 4U);
  EXPECT_LT(chosen[0], 8U);
  EXPECT_GE(chosen[1], 8U);
  EXPECT_LT(chosen[2], 8U);
  EXPECT_GE(chosen[3], 8U);
  EXPECT_EQ(chosen, drawn_samples(ten(), {.samples = 4}));
  EXPECT_EQ(drawn_samples(ten(), {.samples = 100}).size(), 10U);
}

TEST(Samples, AreOfASplitAndOfAName) {
  const intention_scoring::SequenceSet set = small_set();
  EXPECT_THAT(drawn_samples(set, {}), UnorderedElementsAre(0U, 1U));  // what was recorded
  EXPECT_THAT(drawn_samples(set, {.split = "test"}), ElementsAre(3U));
  EXPECT_THAT(drawn_samples(set, {.name = "b"}), ElementsAre(1U));
  EXPECT_THAT(drawn_samples(set, {.name = "nobody"}), IsEmpty());
  EXPECT_THAT(drawn_samples({}, {}), IsEmpty());
}

TEST(ThePage, TellsWhatWasDrawnAndHoldsLabelsMarksAndBeliefs) {
  intention_scoring::SequenceSet set = small_set();
  set.sequences[1].crossing_times = {3.0};
  set.sequences[1].braking_times = {2.0};
  const std::vector<std::size_t> chosen{1};
  const auto beliefs = intention_scoring::all_heads(std::string(40, 'B'));
  const auto page = sample_page(set, {.source = "set.h5", .seed = 9}, chosen,
                                std::vector<intention_scoring::Forecasts>{beliefs});
  EXPECT_THAT(page.lines, ElementsAre("1 of set.h5, seed 9. Labels above, beliefs of the model "
                                      "below."));
  ASSERT_EQ(page.samples.size(), 1U);
  const report::IntentionSample& sample = page.samples[0];
  EXPECT_EQ(sample.title, "b");
  EXPECT_THAT(sample.lines, ElementsAre("lankershim, b, part-1"));
  EXPECT_EQ(sample.labels[0], 0U);
  EXPECT_EQ(sample.labels[39], 3U);
  EXPECT_THAT(sample.marks, ElementsAre(2.0, 3.0));
  ASSERT_EQ(sample.bands.size(), 2U);
  EXPECT_EQ(sample.bands[1].name, "in 1 s");
  EXPECT_EQ(sample.bands[1].shares, beliefs.at[2]);
}

TEST(ThePage, WithoutAModelHasNoBeliefs) {
  const intention_scoring::SequenceSet set = small_set();
  const std::vector<std::size_t> chosen{0, 1};
  EXPECT_TRUE(sample_page(set, {}, chosen, {}).samples[1].bands.empty());
  EXPECT_THROW((void)sample_page(set, {}, chosen, std::vector<intention_scoring::Forecasts>(1)),
               ContractViolation);
  EXPECT_EQ(sequences_of(set, chosen)[1].name, "b");
}

}  // namespace
}  // namespace saca::intention_study::sample_page_test
