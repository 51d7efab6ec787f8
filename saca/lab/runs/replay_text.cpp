#include "saca/lab/runs/replay_text.h"

#include <fmt/core.h>

#include <iterator>

namespace saca::runs {

std::string replay_text(const runtime::TapeFile& tape, const runtime::Replay& replay) {
  const runtime::TapeHeader& header = tape.header;
  std::string all;
  const auto text = std::back_inserter(all);
  fmt::format_to(text, "Recorded{}{}: {} steps at pace {}, car {}, language model {}.\n",
                 header.scenario.empty() ? "" : " in ", header.scenario, tape.content.steps.size(),
                 name(header.pace), header.car, header.model);
  const auto row = [&](const char* what, const runtime::Reproduction& of) {
    fmt::format_to(text, "  {:<34} {:>6} of {:>6}\n", what, of.same, of.recorded);
  };
  fmt::format_to(text, "Worked out again, the same to the last bit:\n");
  row("verdicts", replay.verdicts);
  row("choices at a trigger", replay.decisions);
  row("switches to another plan", replay.switches);
  row("answers of the reflex plane", replay.answers);
  row("scenes with what was believed", replay.beliefs);
  if (tape.content.dropped + tape.content.lost > 0) {
    fmt::format_to(text, "The tape had no room for {} earlier and {} later steps.\n",
                   tape.content.dropped, tape.content.lost);
  }
  if (replay.verdicts_not_compared + replay.beliefs_not_compared > 0) {
    fmt::format_to(text,
                   "Not compared, because the tape does not have what they come from: {} verdicts, "
                   "the beliefs of {} scenes.\n",
                   replay.verdicts_not_compared, replay.beliefs_not_compared);
  }
  if (replay.first) {
    fmt::format_to(text, "The first difference is at {} s, step {}: {} was {}, and is {} now.\n",
                   replay.first->time, replay.first->scene, replay.first->what,
                   replay.first->recorded, replay.first->got);
  }
  return all;
}

}  // namespace saca::runs
