#include "saca/thinking/arbitration/event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/scripted_model.h"
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

TEST(Event, SaysWhyTheMatchingPlanIsNotBegun) {
  reflex::Decision decision{.plan = manoeuvre::doing_nothing,
                            .source = reflex::Source::arbiter,
                            .similarity = 0.95,
                            .preview = 0};
  EXPECT_THAT(decision_text(decision), HasSubstr("95 % like forecast 1, whose plan is not begun, "
                                                 "for doing nothing is as good"));
  decision.not_admissible = true;
  EXPECT_THAT(decision_text(decision), HasSubstr(", whose plan would do too much harm from here"));
  decision.not_admissible = false;
  decision.similarity = 0.5;
  EXPECT_THAT(decision_text(decision), HasSubstr(", not more than 90 %"));
}

/// AEB was chosen by a model whose reasons did not hold.
Preview badly_explained() {
  Preview preview{.situation = language_model::example_situation()};
  preview.prompt = prompt_of(preview);
  preview.reply.reasoning = "1. So AEB: it hits truck1.\n";
  preview.reply.answers = {{.probability = {1.0}, .kind = language_model::Answer::Kind::ended}};
  return preview;
}

TEST(Event, ReasonsThatDoNotHoldAreToldAgainByTheModel) {
  ManualClock clock;
  language_model::ScriptedModel model(
      language_model::ScriptedReply{.lines = {{.text = language_model::example_reasons,
                                               .answer = language_model::Answer::Kind::ended}}},
      clock);
  Preview preview = badly_explained();
  ASSERT_TRUE(explanation(preview).has_value());
  EXPECT_EQ(explanation(preview)->from, language_model::Explanation::From::facts);
  preview.retold = retold(preview, model, clock);
  EXPECT_EQ(model.last_scenes(), std::vector{preview.prompt});
  EXPECT_EQ(model.last_grammars(), std::vector{grammar_of(preview, manoeuvre::PolicyId::aeb)});
  EXPECT_EQ(explanation(preview)->from, language_model::Explanation::From::model);
  EXPECT_EQ(explanation(preview)->tries, 2);
}

TEST(Event, AModelThatWasNotAskedIsNotAskedForReasons) {
  ManualClock clock;
  language_model::ScriptedModel model(manoeuvre::PolicyId::aeb, clock);
  Preview preview = badly_explained();
  preview.reply = {};
  EXPECT_FALSE(retold(preview, model, clock).has_value());
  preview.plan = manoeuvre::full_braking;
  EXPECT_EQ(retold(preview, model, clock)->from, language_model::Explanation::From::facts);
  EXPECT_EQ(model.num_asked(), 0);
}

}  // namespace
}  // namespace saca::arbitration::event_test
