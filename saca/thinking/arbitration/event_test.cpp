#include "saca/thinking/arbitration/event.h"

#include <gtest/gtest.h>

namespace saca::arbitration::event_test {
namespace {

// docs/formats.md promises these words.
TEST(Event, HasTheNamesOfTheFormat) {
  EXPECT_EQ(name(Plane::world), "world");
  EXPECT_EQ(name(Plane::thinking), "thinking");
  EXPECT_EQ(name(EventKind::preview), "preview");
  EXPECT_EQ(name(EventKind::first_answer), "first_answer");
  EXPECT_EQ(name(EventKind::fault), "fault");
}

TEST(Event, SaysHowManyWereNotTold) {
  const Event event = events_not_told(2.5, Plane::thinking, 3);
  EXPECT_EQ(event.kind, EventKind::fault);
  EXPECT_EQ(event.time, 2.5);
  EXPECT_EQ(event.text.substr(0, 8), "3 events");
}

}  // namespace
}  // namespace saca::arbitration::event_test
