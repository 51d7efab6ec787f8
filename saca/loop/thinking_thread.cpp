#include "saca/loop/thinking_thread.h"

#include <exception>
#include <memory>

namespace saca::loop {
namespace {

constexpr Clock::Time pause = std::chrono::milliseconds(2);  // between looks at an empty slot
constexpr Clock::Time breath =
    std::chrono::milliseconds(200);  // between rounds: plans change slowly

}  // namespace

ThinkingThread::ThinkingThread(decide::ThinkingPlane& plane, LatestSlot<TimedScene>& scenes,
                               Clock& clock)
    : plane_(plane),
      scenes_(scenes),
      clock_(clock),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::string ThinkingThread::finish() {
  thread_.request_stop();
  if (thread_.joinable()) {
    thread_.join();
  }
  return fault_;
}

void ThinkingThread::run(const std::stop_token& stop) {
  const auto newest = std::make_unique<TimedScene>();
  while (!stop.stop_requested()) {
    if (!scenes_.take(*newest)) {
      clock_.wait_until_or_stop(clock_.now() + pause, stop);
      continue;
    }
    try {
      plane_.think(newest->scene, newest->beliefs, newest->at, stop);
    } catch (const std::exception& problem) {  // a bug there must not end the plane that drives
      fault_ = problem.what();
      return;
    }
    clock_.wait_until_or_stop(clock_.now() + breath, stop);
  }
}

}  // namespace saca::loop
