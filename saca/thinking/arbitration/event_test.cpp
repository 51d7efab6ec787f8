#include "saca/thinking/arbitration/event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "tests/support/scenes.h"

namespace saca::arbitration::event_test {
namespace {

using testing::HasSubstr;

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

TEST(Event, SaysThatAndWhyItActsBeforeT1) {
  EXPECT_THAT(trigger_text(test::car(1, {50.0, 0.0}), 2.4, 0.02),
              testing::AllOf(HasSubstr("before T1"), HasSubstr("0.0200 more")));
  EXPECT_THAT(trigger_text(test::car(1, {26.0, 0.0}), 1.3, std::nullopt),
              testing::Not(HasSubstr("before T1")));
}

TEST(Event, SaysWhatCannotBeDriven) {
  reflex::Decision decision{.plan = manoeuvre::full_braking};
  decision.refused = {{manoeuvre::PolicyId::aes_left, std::nullopt}, manoeuvre::Refusal::speed};
  EXPECT_THAT(decision_text(decision), HasSubstr("AES-L cannot be driven from here (speed)"));
}

}  // namespace
}  // namespace saca::arbitration::event_test
