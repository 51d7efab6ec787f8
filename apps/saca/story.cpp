#include "apps/saca/story.h"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <iterator>

#include "saca/core/printable.h"
#include "saca/outcome/describe.h"

namespace saca::app {
namespace {

constexpr const char* plain = "\033[0m";
constexpr std::size_t longest_event = 2'000;  // characters; a terminal need not show more

const char* colour_of(decide::EventKind kind) {
  using decide::EventKind;
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

void Story::on_event(const decide::Event& event) {
  say(fmt::format("{}{:7.2f} s  {:8}  {}{}\n", colour_ ? colour_of(event.kind) : "", event.time,
                  name(event.plane), one_line(event.text, longest_event), colour_ ? plain : ""));
}

void Story::on_reasoning(std::int32_t, std::string_view) {
  // Three replies grow together; the report has them in full.
}

void Story::headline(const sim::Scenario& scenario, const loop::Setup& setup) {
  waiting_ += fmt::format("{}\n{}\nPace {}, grip {:.2f}, language model: {}, forecasts: {}.\n\n",
                          printable(scenario.title), printable(scenario.source), name(setup.pace),
                          scenario.grip,
                          setup.model == nullptr ? "off" : one_line(setup.model->description()),
                          setup.atlas == nullptr ? "rolled out" : "from the atlas");
  write_waiting(0);
}

void Story::ending(const sim::Scenario& scenario, const loop::Record& record) {
  std::string text = "\n";
  const auto line = std::back_inserter(text);
  if (!scenario.driver.empty()) {
    fmt::format_to(line, "The driver: {}\n", printable(scenario.driver));
  }
  if (record.driver) {
    fmt::format_to(line, "The drive as recorded: {}.\n",
                   outcome::describe(*record.driver, record.met_by_driver));
  }
  if (!record.decision) {
    fmt::format_to(line, "SACA: never triggered; {}.\n",
                   outcome::describe(record.result, record.met));
    say(text);
    return;
  }
  const manoeuvre::PolicyId chosen = record.decision->plan.policy;
  fmt::format_to(line, "SACA: {} {}, {}. Collision Loss {:.2f}, harm {:.4f}.\n",
                 manoeuvre::index(chosen), name(chosen),
                 outcome::describe(record.result, record.met), record.result.collision_loss,
                 record.result.harm);
  const preview::PolicyFacts& best = (*record.hindsight)[manoeuvre::index(*record.best)].facts;
  fmt::format_to(line, "Best in hindsight: {} {}, {}{}.\n", manoeuvre::index(*record.best),
                 name(*record.best), outcome::describe(best.outcome(), *record.at_trigger),
                 *record.best == chosen ? ": the same" : "");
  say(text);
}

void Story::on_review(std::string_view text) {
  say(fmt::format("{}{}", reviewing_ ? "" : "\nThe language model looks back:\n", printable(text)));
  reviewing_ = true;
}

void Story::on_report(const std::string& file) {
  say(fmt::format("{}Report: {}\n", reviewing_ ? "\n\n" : "", one_line(file, longest_event)));
}

}  // namespace saca::app
