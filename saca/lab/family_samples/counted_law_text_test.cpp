#include "saca/lab/family_samples/counted_law_text.h"

#include <gmock/gmock.h>

namespace saca::family_samples::counted_law_text_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using world::CueKind;

// Jeffreys: 5.5 of 11 is 0.5; 1.5 of 4 is 0.375; both together 6.5 of 14 is 0.46428..., which is
// rounded up.
TEST(CountedLawText, SaysOfEachNumberWhereItComesFrom) {
  intent::CueLaw law;
  for (const CueKind kind :
       {CueKind::parked_vans, CueKind::work_zone, CueKind::emergency_vehicle}) {
    law.unseen[static_cast<std::size_t>(kind)] =
        intent::Unseen{.who = world::ActorKind::pedestrian, .probability = 0.9};
  }
  eval::CueCounts counts{};
  counts[static_cast<std::size_t>(CueKind::parked_vans)] = {.there = 10, .came = 5};
  counts[static_cast<std::size_t>(CueKind::work_zone)] = {.there = 3, .came = 1};
  const std::string text = counted_law_text(law, counts, "cues");
  EXPECT_THAT(text, testing::StartsWith("# What cues of a scene stand for"));
  EXPECT_THAT(text, HasSubstr("counted: 5 of 10 encounters of suite cues, tuning split"));
  EXPECT_THAT(text, HasSubstr("counted: 1 of 3 encounters of suite cues, tuning split"));
  EXPECT_THAT(text, HasSubstr("assumption: as all who were counted together, 6 of 13"));
  EXPECT_THAT(text, Not(HasSubstr("low_sun")));  // the law says nothing of it
  const auto back = intent::read_cue_law(text, "text");
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_DOUBLE_EQ(back.value().of(CueKind::parked_vans)->probability, 0.5);
  EXPECT_DOUBLE_EQ(back.value().of(CueKind::work_zone)->probability, 0.375);
  EXPECT_DOUBLE_EQ(back.value().of(CueKind::emergency_vehicle)->probability, 0.4643);
}

}  // namespace
}  // namespace saca::family_samples::counted_law_text_test
