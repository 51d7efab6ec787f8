#include "saca/decide/event.h"

#include <gtest/gtest.h>

namespace saca::decide::event_test {
namespace {

// docs/formats.md promises these words.
TEST(Event, HasTheNamesOfTheFormat) {
  EXPECT_EQ(name(Plane::world), "world");
  EXPECT_EQ(name(Plane::thinking), "thinking");
  EXPECT_EQ(name(EventKind::preview), "preview");
  EXPECT_EQ(name(EventKind::first_answer), "first_answer");
  EXPECT_EQ(name(EventKind::fault), "fault");
}

}  // namespace
}  // namespace saca::decide::event_test
