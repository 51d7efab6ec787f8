#include "saca/lab/curricula/curriculum_text.h"

#include <gmock/gmock.h>

#include "saca/lab/curricula/episodes_for_test.h"

namespace saca::curricula::curriculum_text_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

TEST(CurriculumText, HasALineForEachMethodAndPair) {
  const std::string text = text_of(some_episodes());
  EXPECT_THAT(text, StartsWith("2 encounters of each of 2 seeds; means over seeds with 95 % "
                               "intervals\n\n"));
  // Harm and regret; 25 % materially worse than AEB; nobody acts; it thinks of no forecast; no
  // case.
  EXPECT_THAT(text, ContainsRegex("\nfrozen +0\\.1500 \\(.* to .*\\) +0\\.1500 \\(.*\\) +25\\.0 "
                                  "+0\\.0 +- +0\n"));
  // From memory: (1/4 + 2/2) / 2. Cases: (2 + 3) / 2, and half goes to even.
  EXPECT_THAT(text, ContainsRegex("\nlearning .* 62\\.5 +2\n"));
  EXPECT_THAT(text, ContainsRegex("\naeb .* - +-\n"));
  EXPECT_THAT(text, ContainsRegex("\nlearning does 0\\.00000 \\(.*\\) more harm than frozen\n"));
  EXPECT_THAT(text, ContainsRegex("\ncorrected does -0\\.02500 \\(.*\\) more harm than drawn\n$"));
}

TEST(CurriculumText, TellsWhatIsLeftOut) {
  auto episodes = some_episodes();
  episodes[1].of[0].row.fault = "no road";
  EXPECT_THAT(text_of(episodes), HasSubstr("\n1 episodes are left out; the first: no road\n"));
}

// Of one seed there is no interval.
TEST(CurriculumText, OfOneSeedTheIntervalIsTheValue) {
  std::vector<eval::Episodes> one(1);
  one[0].of = {harming({0.5, 0.5, 0.5, 0.5, 0.5, 0.5})};
  one[0].size = {{0, 1, 1}};
  EXPECT_THAT(text_of(one), HasSubstr("0.5000 (0.5000 to 0.5000)"));
}

}  // namespace
}  // namespace saca::curricula::curriculum_text_test
