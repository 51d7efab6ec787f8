#include "saca/base/core/suggestion.h"

#include <gtest/gtest.h>

namespace saca::suggestion_test {
namespace {

using Words = std::vector<std::string>;

// Known distances: kitten to sitting is the textbook's example; "ca" to "ac" is one exchange.
TEST(TypingDistance, CountsLettersThatWereTypedOtherwise) {
  EXPECT_EQ(typing_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(typing_distance("behavior", "behaviour"), 1U);
  EXPECT_EQ(typing_distance("ca", "ac"), 1U);
  EXPECT_EQ(typing_distance("", "abc"), 3U);
  EXPECT_EQ(typing_distance("abc", ""), 3U);
  EXPECT_EQ(typing_distance("--at_S", "--at-s"), 0U);
}

TEST(TypingDistance, IsAlikeFromBothSidesAndZeroOnlyForTheSame) {
  const Words words{"run", "urn", "runs", "drive", "oracle", "a", ""};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      EXPECT_EQ(typing_distance(a, b), typing_distance(b, a)) << a << ", " << b;
      EXPECT_EQ(typing_distance(a, b) == 0, a == b) << a << ", " << b;
    }
  }
}

TEST(LikelyMeant, IsTheNearestWordOrNone) {
  const Words keys{"name", "grip", "duration_s", "behaviour", "speed_mps", "x_m", "y_m"};
  EXPECT_EQ(likely_meant("behavior", keys), "behaviour");
  EXPECT_EQ(likely_meant("durations_s", keys), "duration_s");
  EXPECT_EQ(likely_meant("Grip", keys), "grip");
  EXPECT_EQ(likely_meant("garp", keys), std::nullopt);  // half of it is otherwise
  EXPECT_EQ(likely_meant("colour", keys), std::nullopt);
  EXPECT_EQ(likely_meant("", keys), std::nullopt);
  EXPECT_EQ(likely_meant("x", Words{"y"}), std::nullopt);
  EXPECT_EQ(likely_meant(std::string(1'000'000, 'a'), keys), std::nullopt);
}

TEST(LikelyMeant, KnowsAWordWithoutItsUnitOrInAnotherOne) {
  const Words keys{"duration_s", "speed_mps", "heading_deg", "heading_sd_deg"};
  EXPECT_EQ(likely_meant("duration", keys), "duration_s");
  EXPECT_EQ(likely_meant("speed", keys), "speed_mps");
  EXPECT_EQ(likely_meant("speed_kmh", keys), "speed_mps");
  EXPECT_EQ(likely_meant("heading_rad", keys), "heading_deg");
  EXPECT_EQ(likely_meant("heading", keys), std::nullopt);  // of two
  EXPECT_EQ(likely_meant("crossing", Words{"crossing_1", "crossing_22", "crossing_3"}),
            std::nullopt);
}

TEST(Suggestion, AsksForWhatIsNearAndElseListsWhatThereIs) {
  const Words words{"run", "replay", "oracle"};
  EXPECT_EQ(suggestion("rnu", words), "did you mean 'run'?");
  EXPECT_EQ(suggestion("fly", words), "want one of run, replay, oracle");
  EXPECT_EQ(suggestion("fly", Words{}), "there is none to choose from");
}

}  // namespace
}  // namespace saca::suggestion_test
