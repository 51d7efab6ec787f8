#include "saca/lab/intention_scoring/manoeuvre_events.h"

#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::manoeuvre_events_test {
namespace {

TEST(ManoeuvreEventsFound, CountByHand) {
  //                                  0123456789012345678901234
  const Sequence sequence = labelled("MMLLLLLLLLLLLLMMBBBBMRRMM");
  const Forecasts said = all_heads("MMMMMMMLLLLLLLLLMMMMMRRRR");
  const ManoeuvreEventsFound found = manoeuvre_events_found(sequence, said);
  const auto& left = found.of[1];
  EXPECT_EQ(left.events.num, 1U);
  EXPECT_EQ(left.events.found, 1U);
  EXPECT_EQ(left.frames[0].num, 3U);  // 0 to 0.2 s
  EXPECT_EQ(left.frames[0].found, 0U);
  EXPECT_EQ(left.frames[1].num, 3U);
  EXPECT_EQ(left.frames[1].found, 1U);
  EXPECT_EQ(left.frames[2].num, 4U);
  EXPECT_EQ(left.frames[2].found, 4U);
  EXPECT_EQ(left.frames[3].num, 2U);  // from 1.0 s on
  EXPECT_EQ(left.frames[4].share(), std::nullopt);
  EXPECT_EQ(found.of[3].events.num, 1U);
  EXPECT_EQ(found.of[3].events.found, 0U);
  EXPECT_EQ(found.of[2].events.share(), 1.0);
  EXPECT_EQ(found.of[0].events.num, 0U);
}

TEST(ManoeuvreEventsFound, PassOverWhatIsInDoubtButNotItsTime) {
  Sequence sequence = labelled("MLLLLLM");
  sequence.scored[1] = sequence.scored[2] = sequence.scored[3] = false;
  const ManoeuvreEventsFound found = manoeuvre_events_found(sequence, all_heads("MLLLLLM"));
  EXPECT_EQ(found.of[1].frames[0].num, 0U);
  EXPECT_EQ(found.of[1].frames[1].num, 2U);
  sequence.scored.assign(sequence.scored.size(), false);
  EXPECT_EQ(manoeuvre_events_found(sequence, all_heads("MLLLLLM")).of[1].events.num, 0U);
}

TEST(ManoeuvreEventsFound, SumsAreMadeOfTheirParts) {
  const Sequence sequence = labelled("MLLM");
  const ManoeuvreEventsFound once = manoeuvre_events_found(sequence, all_heads("MLMM"));
  ManoeuvreEventsFound twice = once;
  twice += once;
  EXPECT_EQ(twice.of[1].events.num, 2U);
  EXPECT_EQ(twice.of[1].frames[0].num, 4U);
  EXPECT_EQ(twice.of[1].frames[0].share(), 0.5);
}

TEST(ManoeuvreEventsFound, RefuseWhatDoesNotFit) {
  EXPECT_THROW((void)manoeuvre_events_found(labelled("ML"), all_heads("M")), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::manoeuvre_events_test
