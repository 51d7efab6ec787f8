#include "saca/learn/acts.h"

#include <gtest/gtest.h>

#include "saca/core/contract.h"
#include "saca/learn/sequences_for_test.h"

namespace saca::learn::acts_test {
namespace {

TEST(ActsFound, CountByHand) {
  //                                  0123456789012345678901234
  const Sequence sequence = labelled("MMLLLLLLLLLLLLMMBBBBMRRMM");
  const Forecasts said = all_heads("MMMMMMMLLLLLLLLLMMMMMRRRR");
  const ActsFound found = acts_found(sequence, said);
  const auto& left = found.of[1];
  EXPECT_EQ(left.acts.num, 1U);
  EXPECT_EQ(left.acts.found, 1U);
  EXPECT_EQ(left.frames[0].num, 3U);  // 0 to 0.2 s
  EXPECT_EQ(left.frames[0].found, 0U);
  EXPECT_EQ(left.frames[1].num, 3U);
  EXPECT_EQ(left.frames[1].found, 1U);
  EXPECT_EQ(left.frames[2].num, 4U);
  EXPECT_EQ(left.frames[2].found, 4U);
  EXPECT_EQ(left.frames[3].num, 2U);  // from 1.0 s on
  EXPECT_EQ(left.frames[4].share(), std::nullopt);
  EXPECT_EQ(found.of[3].acts.num, 1U);
  EXPECT_EQ(found.of[3].acts.found, 0U);
  EXPECT_EQ(found.of[2].acts.share(), 1.0);
  EXPECT_EQ(found.of[0].acts.num, 0U);
}

TEST(ActsFound, PassOverWhatIsInDoubtButNotItsTime) {
  Sequence sequence = labelled("MLLLLLM");
  sequence.scored[1] = sequence.scored[2] = sequence.scored[3] = false;
  const ActsFound found = acts_found(sequence, all_heads("MLLLLLM"));
  EXPECT_EQ(found.of[1].frames[0].num, 0U);
  EXPECT_EQ(found.of[1].frames[1].num, 2U);
  sequence.scored.assign(sequence.scored.size(), false);
  EXPECT_EQ(acts_found(sequence, all_heads("MLLLLLM")).of[1].acts.num, 0U);
}

TEST(ActsFound, SumsAreMadeOfTheirParts) {
  const Sequence sequence = labelled("MLLM");
  const ActsFound once = acts_found(sequence, all_heads("MLMM"));
  ActsFound twice = once;
  twice += once;
  EXPECT_EQ(twice.of[1].acts.num, 2U);
  EXPECT_EQ(twice.of[1].frames[0].num, 4U);
  EXPECT_EQ(twice.of[1].frames[0].share(), 0.5);
}

TEST(ActsFound, RefuseWhatDoesNotFit) {
  EXPECT_THROW((void)acts_found(labelled("ML"), all_heads("M")), ContractViolation);
}

}  // namespace
}  // namespace saca::learn::acts_test
