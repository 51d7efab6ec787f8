#include "saca/lab/runs/replay_text.h"

#include <gmock/gmock.h>

#include "saca/lab/runs/replay_for_test.h"

namespace saca::runs::replay_text_test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(AReplaysText, CountsWhatCameBack) {
  EXPECT_EQ(replay_text(small_tape(), small_replay()),
            "Recorded in one_way: 3 steps at pace lockstep, car compact, language model off.\n"
            "Worked out again, the same to the last bit:\n"
            "  verdicts                                2 of      2\n"
            "  choices at a trigger                    1 of      1\n"
            "  switches to another plan                0 of      0\n"
            "  answers of the reflex plane             3 of      3\n"
            "  scenes with what was believed           3 of      3\n");
}

TEST(AReplaysText, TellsWhatIsMissingAndWhatDiffers) {
  runtime::TapeFile tape = small_tape();
  tape.header.scenario = "";
  tape.content.lost = 5;
  runtime::Replay replay = small_replay();
  replay.beliefs_not_compared = 7;
  replay.first = small_difference();
  const std::string text = replay_text(tape, replay);
  EXPECT_THAT(text, StartsWith("Recorded: 3 steps"));
  EXPECT_THAT(text, HasSubstr("The tape had no room for 0 earlier and 5 later steps.\n"));
  EXPECT_THAT(text, HasSubstr("come from: 0 verdicts, the beliefs of 7 scenes.\n"));
  EXPECT_THAT(text, EndsWith("The first difference is at 0.25 s, step 2: verdict.plans[3].harm was "
                             "0.5, and is null now.\n"));
}

}  // namespace
}  // namespace saca::runs::replay_text_test
