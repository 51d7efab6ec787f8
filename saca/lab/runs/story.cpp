#include "saca/lab/runs/story.h"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstring>
#include <iterator>

#include "saca/base/core/printable.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::runs {
namespace {

constexpr const char* plain = "\033[0m";
constexpr std::size_t longest_event = 2'000;  // characters; a terminal need not show more

const char* colour_of(arbitration::EventKind kind) {
  using arbitration::EventKind;
  switch (kind) {
    case EventKind::trigger:
    case EventKind::match:
    case EventKind::execute:
      return "\033[1m";
    case EventKind::contact:
    case EventKind::fault:
      return "\033[31m";
    case EventKind::cached:
    case EventKind::rest:
      return "\033[32m";
    default:
      return "";
  }
}

/// What was begun at the trigger, and after it.
std::string done(const encounter::Record& record) {
  std::string text = manoeuvre::plan_text(record.decision->plan);
  for (const encounter::TimedSwitch& each : record.switches) {
    text += fmt::format(", from {:.2f} s on {}", each.time, manoeuvre::plan_text(each.change.plan));
  }
  return text;
}

/// What would have been best beside what came of what was done.
std::string beside(const preview::PolicyFacts& best, const encounter::Record& record) {
  const double more = record.result.harm - best.outcome().harm;
  if (std::abs(more) >= collision::harm_tie) {
    return more > 0.0 ? fmt::format("It harms {:.4f} less.", more)
                      : fmt::format("What was done harmed {:.4f} less.", -more);
  }
  return record.switches.empty() && best.plan == record.decision->plan
             ? "That is what was done."
             : "It harms as much as what was done.";
}

}  // namespace

void Story::say(const std::string& text) {
  waiting_ += text;
  write_waiting(patience);
}

void Story::write_waiting(int seconds) {
  while (file_ && !problem_ && !waiting_.empty()) {
    pollfd output{.fd = *file_, .events = POLLOUT, .revents = 0};
    const int num_ready = ::poll(&output, 1, 1'000 * seconds);
    if (num_ready < 0) {
      continue;  // a signal came
    }
    if (num_ready == 0 && seconds == 0) {
      return;
    }
    if (num_ready == 0) {
      problem_ = Error{Error::Code::unwritable,
                       fmt::format("standard output: nobody has read it for {} s", seconds)};
      return;
    }
    // A pipe that can be written to takes so much without waiting.
    const ssize_t num_written =
        ::write(*file_, waiting_.data(), std::min<std::size_t>(waiting_.size(), PIPE_BUF));
    if (num_written >= 0) {
      waiting_.erase(0, static_cast<std::size_t>(num_written));
    } else if (errno != EINTR && errno != EAGAIN) {
      problem_ = Error{Error::Code::unwritable,
                       fmt::format("standard output: cannot be written: {}", std::strerror(errno))};
    }
  }
}

void Story::on_event(const arbitration::Event& event) {
  say(fmt::format("{}{:7.2f} s  {:8}  {}{}\n", colour_ ? colour_of(event.kind) : "", event.time,
                  name(event.plane), one_line(event.text, longest_event), colour_ ? plain : ""));
}

void Story::on_reasoning(std::int32_t, std::string_view) {
  // Three replies grow together; the report has them in full.
}

void Story::headline(const scenario::Scenario& scenario, const encounter::Setup& setup) {
  waiting_ += fmt::format("{}\n{}\nPace {}, grip {:.2f}, language model: {}, forecasts: {}.\n",
                          printable(scenario.title), printable(scenario.source), name(setup.pace),
                          scenario.grip,
                          setup.model == nullptr ? "off" : one_line(setup.model->description()),
                          setup.atlas == nullptr ? "rolled out" : "from the atlas");
  waiting_ += fmt::format(
      "T2: {:.1f} s to a conflict, SACA takes the wheel and previews. T1: {:.1f} s, it acts{}. "
      "AEB emergency braking,\nAES-L/-R a lane change to the left or right, ES-B-L/-R the same "
      "while braking, T-D-L/-R a drift to a stop facing\nleft or right, NI nothing. Intentions: M "
      "goes on, FB brakes, LC/RC changes to the left or right, LB/RB brakes too.\n\n",
      setup.thresholds.preview, setup.thresholds.trigger,
      setup.thresholds.waiting_cost ? ", or before where waiting would cost harm" : "");
  write_waiting(0);
}

void Story::ending(const scenario::Scenario& scenario, const encounter::Record& record,
                   const std::vector<std::string>& in_short) {
  std::string text = "\n";
  const auto line = std::back_inserter(text);
  for (const std::string& sentence : in_short) {
    fmt::format_to(line, "{}\n", printable(sentence));
  }
  if (!scenario.driver.empty()) {
    fmt::format_to(line, "The driver: {}\n", printable(scenario.driver));
  }
  if (record.driver) {
    fmt::format_to(line, "The drive as recorded: {}.\n",
                   rollout::describe(*record.driver, record.met_by_driver));
  }
  if (!record.decision) {
    fmt::format_to(line, "SACA: never triggered; {}.\n",
                   rollout::describe(record.result, record.met));
    say(text);
    return;
  }
  fmt::format_to(line, "SACA: {}, {}. Collision Loss {:.2f}, harm {:.4f}.\n", done(record),
                 rollout::describe(record.result, record.met), record.result.collision_loss,
                 record.result.harm);
  const preview::PolicyFacts& best = (*record.hindsight)[manoeuvre::index(*record.best)].facts;
  fmt::format_to(line, "Best in hindsight, kept to the end: {}, {}. {}\n",
                 manoeuvre::plan_text(best.plan),
                 rollout::describe(best.outcome(), *record.at_trigger), beside(best, record));
  say(text);
}

void Story::on_review(std::string_view text) {
  say(fmt::format("{}{}", reviewing_ ? "" : "\nThe language model looks back:\n", printable(text)));
  reviewing_ = true;
}

void Story::on_truth(const language_model::Truth& truth) {
  if (truth.num_checked == 0) {
    return;
  }
  const auto checked = static_cast<std::size_t>(truth.num_checked);
  std::string text = fmt::format("\n{} of {} statements that can be checked are true.\n",
                                 checked - truth.wrong.size(), checked);
  for (const language_model::FalseStatement& each : truth.wrong) {
    text += fmt::format("  false: \"{}\": {}\n", one_line(each.text, longest_event),
                        one_line(each.why, longest_event));
  }
  say(text);
}

void Story::on_shown(const language_model::Explanation& shown) {
  if (shown.tries > 1) {
    const bool by_facts = shown.from == language_model::Explanation::From::facts;
    say(fmt::format("\n{} try {}:\n{}", by_facts ? "By the figures, after" : "What holds, in",
                    shown.tries, printable(shown.text)));
  }
}

void Story::on_report(const std::string& file) {
  say(fmt::format("{}Report: {}\n", reviewing_ ? "\n" : "", one_line(file, longest_event)));
}

}  // namespace saca::runs
