#include "saca/lab/family_samples/drawn_cues.h"

#include <gmock/gmock.h>

#include "saca/lab/scenario/scenario.h"

namespace saca::family_samples::drawn_cues_test {
namespace {

using testing::HasSubstr;

eval::SuiteSource suite(const char* name) {
  return eval::SuiteSource::open({.scenarios = "scenarios",
                                  .suite = name,
                                  .test_log = std::nullopt,
                                  .car = "compact_rwd_ev",
                                  .footprint = scenario::standard_ego,
                                  .other_names = {}})
      .value();
}

TEST(DrawnCues, AreThoseOfTheFirstEncounters) {
  const eval::SuiteSource source = suite("cues");
  const auto drawn = drawn_cues(source, "cues", 5);
  ASSERT_TRUE(drawn.has_value()) << drawn.error().message;
  ASSERT_EQ(drawn.value().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto sample = source.sample(k).value();
    ASSERT_EQ(drawn.value()[k].size(), sample.cues.size());
    EXPECT_FALSE(sample.cues.empty());
    EXPECT_EQ(drawn.value()[k][0].kind, sample.cues[0].kind);
    EXPECT_EQ(drawn.value()[k][0].comes, sample.cues[0].comes);
  }
}

TEST(DrawnCues, ASuiteWithoutCuesIsRefused) {
  const auto refused = drawn_cues(suite("balanced"), "balanced", 2);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::out_of_range);
  EXPECT_THAT(refused.error().message, HasSubstr("balanced: want a suite with cues"));
}

}  // namespace
}  // namespace saca::family_samples::drawn_cues_test
