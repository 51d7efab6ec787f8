#include "saca/runtime/work_thread.h"

#include <exception>
#include <memory>
#include <utility>

#include "saca/base/core/processor_time.h"

namespace saca::runtime {
namespace {

constexpr Clock::Time pause = std::chrono::milliseconds(2);  // between looks at an empty slot

}  // namespace

WorkThread::WorkThread(LatestSlot<TimedScene>& scenes, Clock& clock, Clock::Time breath, Work work)
    : scenes_(scenes),
      clock_(clock),
      breath_(breath),
      work_(std::move(work)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::string WorkThread::finish() {
  thread_.request_stop();
  if (thread_.joinable()) {
    thread_.join();
  }
  return fault_;
}

void WorkThread::run(const std::stop_token& stop) {
  const auto newest = std::make_unique<TimedScene>();
  while (!stop.stop_requested()) {
    if (!scenes_.take(*newest)) {
      clock_.wait_until_or_stop(clock_.now() + pause, stop);
      continue;
    }
    try {
      work_(*newest, stop);
    } catch (const std::exception& problem) {  // a bug there must not end the plane that drives
      note(problem.what());
    } catch (...) {
      note("something that says nothing of itself");
    }
    clock_.wait_until_or_stop(clock_.now() + breath_, stop);
  }
  computed_ = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
}

void WorkThread::note(const std::string& fault) {
  if (fault_.empty()) {
    fault_ = fault;
  }
}

}  // namespace saca::runtime
