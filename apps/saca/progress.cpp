#include "apps/saca/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <csignal>

#include "apps/saca/settings.h"
#include "saca/base/core/printable.h"

namespace saca::app {
namespace {

volatile std::sig_atomic_t asked_to_stop = 0;

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, [](int) { asked_to_stop = 1; });
  std::signal(SIGTERM, [](int) { asked_to_stop = 1; });
}

bool interrupted() {
  return asked_to_stop != 0;
}

InterruptStop::InterruptStop()
    : thread_([this](const std::stop_token& end) {
        while (!end.stop_requested() && !interrupted()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        if (interrupted()) {
          stop_.request_stop();
        }
      }) {}

ProgressLine::ProgressLine(std::string_view what, int all, Clock& clock)
    : what_(one_line(what)),
      all_(all),
      clock_(clock),
      start_(clock.now()),
      last_(start_),
      terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (settings().quiet) {
    return;
  }
  if (terminal_) {
    fmt::print(stderr, "\n");
  } else if (shown_) {
    fmt::print(stderr, "{}: {} of at most {}{}, {:.0f} s\n", what_, done_, all_, more_,
               to_seconds(clock_.now() - start_));
  }
}

void ProgressLine::show(int done, int remembered, const std::string& more) {
  done_ = done;
  more_ = more;
  shown_ = true;
  const Clock::Time now = clock_.now();
  if (settings().quiet || !terminal_ || (done != all_ && to_seconds(now - last_) < 0.2)) {
    return;
  }
  last_ = now;
  const int worked = done - remembered;
  const double left = worked == 0 ? 0.0 : to_seconds(now - start_) / worked * (all_ - done);
  fmt::print(stderr, "\r{}: {} of at most {}{}, {:.0f} s left   ", what_, done, all_, more, left);
}

}  // namespace saca::app
