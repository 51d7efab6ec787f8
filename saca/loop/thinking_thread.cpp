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
    : plane_(plane), scenes_(scenes), clock_(clock), thread_([this] { run(); }) {}

ThinkingThread::~ThinkingThread() {
  finish();
}

std::string ThinkingThread::finish() {
  stop_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
  return fault_;
}

void ThinkingThread::run() {
  const auto newest = std::make_unique<TimedScene>();
  while (!stop_) {
    if (!scenes_.take(*newest)) {
      clock_.wait_until(clock_.now() + pause);
      continue;
    }
    try {
      plane_.think(newest->scene, newest->beliefs, newest->at);
    } catch (const std::exception& problem) {  // a bug there must not end the plane that drives
      fault_ = problem.what();
      return;
    }
    clock_.wait_until(clock_.now() + breath);
  }
}

}  // namespace saca::loop
