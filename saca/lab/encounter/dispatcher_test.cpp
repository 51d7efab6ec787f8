#include "saca/lab/encounter/dispatcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <latch>
#include <semaphore>
#include <stdexcept>
#include <vector>

namespace saca::encounter::dispatcher_test {
namespace {

using arbitration::Event;
using arbitration::EventKind;
using arbitration::Plane;
using Producer = Dispatcher::Producer;
using testing::ElementsAre;
using testing::HasSubstr;

Event event(double time, const std::string& text) {
  return {time, Plane::reflex, EventKind::match, text};
}

/// Writes down what it hears; where `opens` is given, the first call blocks until it opens.
class Notes : public Listener {
 public:
  explicit Notes(std::latch* opens = nullptr) : opens_(opens) {}
  void on_event(const Event& event) override {
    if (opens_ != nullptr) {
      blocked_.release();
      std::exchange(opens_, nullptr)->wait();
    }
    texts_.push_back(event.text);
    last_ = event;
  }
  void on_reasoning(std::int32_t preview, std::string_view text) override {
    texts_.push_back(std::to_string(preview) + ": " + std::string(text));
  }

  std::binary_semaphore blocked_{0};  ///< released when the first call has begun
  std::vector<std::string> texts_;
  Event last_;

 private:
  std::latch* opens_;
};

TEST(Dispatcher, TellsAllInOrderBeforeItEnds) {
  Notes notes;
  Dispatcher dispatcher(notes);
  for (int i = 0; i < 500; ++i) {
    dispatcher.event(Producer::driving, event(i, std::to_string(i)));
  }
  dispatcher.finish();
  ASSERT_EQ(notes.texts_.size(), 500U);
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(notes.texts_[static_cast<std::size_t>(i)], std::to_string(i));
  }
}

// While the first event is being told, both threads hand over; what waits is told by time.
TEST(Dispatcher, TellsWhatHasWaitedByTime) {
  std::latch opens(1);
  Notes notes(&opens);
  Dispatcher dispatcher(notes);
  dispatcher.event(Producer::driving, event(0.0, "first"));
  notes.blocked_.acquire();
  dispatcher.event(Producer::driving, event(1.0, "T1"));
  dispatcher.event(Producer::driving, event(3.0, "rest"));
  dispatcher.event(Producer::thinking, event(0.5, "asked"));
  dispatcher.reasoning(2, "left");
  dispatcher.event(Producer::thinking, event(2.0, "answered"));
  opens.count_down();
  dispatcher.finish();
  EXPECT_THAT(notes.texts_, ElementsAre("first", "asked", "2: left", "T1", "answered", "rest"));
}

// Nobody waits for a listener that blocks: these calls return before it is let go. Of ten, four
// fit.
TEST(Dispatcher, CountsWhatDoesNotFitAndTellsHowManyItWere) {
  std::latch opens(1);
  Notes notes(&opens);
  Dispatcher dispatcher(notes, 4);
  dispatcher.event(Producer::driving, event(0.0, "first"));
  notes.blocked_.acquire();
  for (int i = 1; i <= 10; ++i) {
    dispatcher.event(Producer::driving, event(i, std::to_string(i)));
  }
  opens.count_down();
  dispatcher.finish();
  EXPECT_THAT(notes.texts_, ElementsAre("first", "1", "2", "3", "4", HasSubstr("6 events")));
  EXPECT_EQ(notes.last_.kind, EventKind::fault);
  EXPECT_EQ(notes.last_.plane, Plane::reflex);
  EXPECT_EQ(notes.last_.time, 4.0);
}

TEST(Dispatcher, ThrowsWhatTheListenerThrows) {
  class Broken final : public Notes {
   public:
    void on_event(const Event& event) override {
      Notes::on_event(event);
      throw std::runtime_error("the disk is full");
    }
  };
  Broken broken;
  Dispatcher dispatcher(broken);
  dispatcher.event(Producer::driving, event(0.0, "first"));
  dispatcher.event(Producer::driving, event(1.0, "second"));
  EXPECT_THROW(dispatcher.finish(), std::runtime_error);
  EXPECT_THAT(broken.texts_, ElementsAre("first"));
}

TEST(Dispatcher, TellsAllEvenWhereNobodyFinishesIt) {
  Notes notes;
  {
    Dispatcher dispatcher(notes);
    dispatcher.event(Producer::thinking, event(0.0, "first"));
  }
  EXPECT_THAT(notes.texts_, ElementsAre("first"));
}

}  // namespace
}  // namespace saca::encounter::dispatcher_test
