#include "saca/lab/runs/replay_json.h"

#include <gtest/gtest.h>

#include "saca/lab/runs/replay_for_test.h"

namespace saca::runs::replay_json_test {
namespace {

using nlohmann::json;

TEST(AReplaysDocument, CountsWhatCameBack) {
  runtime::TapeFile tape = small_tape();
  tape.content.dropped = 4;
  tape.content.lost = 5;
  runtime::Replay replay = small_replay();
  replay.verdicts_not_compared = 6;
  replay.beliefs_not_compared = 7;
  EXPECT_EQ(replay_json(tape, replay), (json{{"schema", "saca.replay/1"},
                                             {"scenario", "one_way"},
                                             {"verdicts", {{"recorded", 2}, {"same", 2}}},
                                             {"decisions", {{"recorded", 1}, {"same", 1}}},
                                             {"switches", {{"recorded", 0}, {"same", 0}}},
                                             {"answers", {{"recorded", 3}, {"same", 3}}},
                                             {"beliefs", {{"recorded", 3}, {"same", 3}}},
                                             {"verdicts_not_compared", 6},
                                             {"beliefs_not_compared", 7},
                                             {"steps_dropped", 4},
                                             {"steps_lost", 5},
                                             {"first_difference", nullptr}}));
}

TEST(AReplaysDocument, NamesTheFirstDifference) {
  runtime::Replay replay = small_replay();
  replay.first = small_difference();
  EXPECT_EQ(replay_json(small_tape(), replay)["first_difference"],
            (json{{"scene", 2},
                  {"t_s", 0.25},
                  {"what", "verdict.plans[3].harm"},
                  {"recorded", 0.5},
                  {"got", nullptr}}));
}

}  // namespace
}  // namespace saca::runs::replay_json_test
