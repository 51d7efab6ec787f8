#include "saca/lab/long_work/interrupt.h"

#include <chrono>
#include <csignal>

namespace saca::long_work {
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

}  // namespace saca::long_work
