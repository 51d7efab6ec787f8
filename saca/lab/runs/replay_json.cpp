#include "saca/lab/runs/replay_json.h"

namespace saca::runs {
namespace {

using nlohmann::json;

json reproduced_json(const runtime::Reproduction& of) {
  return {{"recorded", of.recorded}, {"same", of.same}};
}

}  // namespace

json replay_json(const runtime::TapeFile& tape, const runtime::Replay& replay) {
  json first;
  if (replay.first) {
    first = {{"scene", replay.first->scene},
             {"t_s", replay.first->time},
             {"what", replay.first->what},
             {"recorded", json::parse(replay.first->recorded)},
             {"got", json::parse(replay.first->got)}};
  }
  return {{"schema", "saca.replay/1"},
          {"scenario", tape.header.scenario},
          {"verdicts", reproduced_json(replay.verdicts)},
          {"decisions", reproduced_json(replay.decisions)},
          {"switches", reproduced_json(replay.switches)},
          {"answers", reproduced_json(replay.answers)},
          {"beliefs", reproduced_json(replay.beliefs)},
          {"verdicts_not_compared", replay.verdicts_not_compared},
          {"beliefs_not_compared", replay.beliefs_not_compared},
          {"steps_dropped", tape.content.dropped},
          {"steps_lost", tape.content.lost},
          {"first_difference", first}};
}

}  // namespace saca::runs
