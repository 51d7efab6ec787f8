#include "saca/lab/long_work/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include "saca/base/core/printable.h"

namespace saca::long_work {

ProgressLine::ProgressLine(std::string_view what, int all, Clock& clock, ProgressDisplay display)
    : what_(one_line(what)),
      all_(all),
      clock_(clock),
      start_(clock.now()),
      last_(start_),
      display_(display),
      terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (display_ == ProgressDisplay::silent) {
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
  if (display_ == ProgressDisplay::silent || !terminal_ ||
      (done != all_ && to_seconds(now - last_) < 0.2)) {
    return;
  }
  last_ = now;
  const int worked = done - remembered;
  const double left = worked == 0 ? 0.0 : to_seconds(now - start_) / worked * (all_ - done);
  fmt::print(stderr, "\r{}: {} of at most {}{}, {:.0f} s left   ", what_, done, all_, more, left);
}

}  // namespace saca::long_work
