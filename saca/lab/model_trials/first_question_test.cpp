#include "saca/lab/model_trials/first_question.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/scenes_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::model_trials::first_question_test {
namespace {

using testing::HasSubstr;

class FirstQuestion : public testing::Test {
 protected:
  [[nodiscard]] auto of(const scenario::Scenario& scenario) {
    return first_question({.scenario = &scenario,
                           .car = &car_,
                           .harm = &harm_,
                           .intent = &intent::shipped_model(),
                           .model = &other_,
                           .clock = &clock_});
  }
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = eval::shipped_harm();
  ManualClock clock_;
  language_model::ScriptedModel other_{manoeuvre::PolicyId::aeb, clock_};
};

// Towards a car that stands: there is much to ask, and no model hears of it.
TEST_F(FirstQuestion, IsWhatTheFirstPreviewsAsk) {
  const auto previews = of(eval::standing_car(15.0, 60.0));
  ASSERT_TRUE(previews.has_value()) << previews.error().message;
  ASSERT_FALSE(previews.value().empty());
  EXPECT_LE(previews.value().size(), language_model::most_scenes);
  for (const arbitration::Preview& preview : previews.value()) {
    EXPECT_THAT(preview.prompt, HasSubstr("Least harm:"));
    EXPECT_TRUE(preview.reply.answers.empty());
  }
  EXPECT_EQ(other_.num_asked(), 0);
}

TEST_F(FirstQuestion, ThereIsNoneWhereNothingThreatens) {
  scenario::Scenario empty = eval::standing_car(15.0, 60.0);
  empty.actors.clear();
  empty.duration = 1.0;
  EXPECT_TRUE(of(empty).value().empty());
}

}  // namespace
}  // namespace saca::model_trials::first_question_test
