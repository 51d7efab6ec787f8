#include "saca/loop/thinking_thread.h"

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
  stop_ = true;
  thread_.join();
}

void ThinkingThread::run() {
  const auto newest = std::make_unique<TimedScene>();
  while (!stop_) {
    if (!scenes_.take(*newest)) {
      clock_.wait_until(clock_.now() + pause);
      continue;
    }
    plane_.think(newest->scene, newest->at);
    clock_.wait_until(clock_.now() + breath);
  }
}

}  // namespace saca::loop
