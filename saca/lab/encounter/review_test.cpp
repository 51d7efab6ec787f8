#include "saca/lab/encounter/review.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/retelling.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::encounter::review_test {
namespace {

using testing::HasSubstr;

/// Somebody stands in the way; asked about a scene the model chooses to brake, looking back it
/// says what `words` are.
class ReviewTest : public testing::Test {
 protected:
  ReviewTest() {
    scenario_.ego = scenario::EgoStart{.pose = {}, .speed = 9.0};
    scenario_.actors.push_back(
        {.id = 1,
         .kind = world::ActorKind::pedestrian,
         .footprint = {.shape = world::Shape::ellipse, .length = 0.5, .width = 0.5},
         .mass = 75.0,
         .motion =
             scenario::Script{.start = {.s = distance}, .behaviour = scenario::Behaviour::hold}});
    setup_ = {.scenario = &scenario_,
              .car = &car_,
              .harm = &harm_,
              .intent = &intent::shipped_model(),
              .model = &model_,
              .clock = &clock_};
  }

  static constexpr double distance = 40.0;
  language_model::ScriptedReply reply(const std::string& prompt) {
    language_model::ScriptedReply said{.lines = {{.answer = language_model::Answer::Kind::first}}};
    if (prompt.starts_with("# Review")) {
      said = fault_
                 ? language_model::ScriptedReply{.error = fault_}
                 : language_model::ScriptedReply{
                       .lines = {{.text = words_, .answer = language_model::Answer::Kind::ended}}};
    }
    return said;
  }

  scenario::Scenario scenario_{
      .name = "walker", .title = "A walker", .car = "x", .grip = 0.9, .duration = 4.0};
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
  ManualClock clock_;
  std::string words_ = "1. NI hits pedestrian1.\n2. AES-L is not possible.";
  std::optional<Error> fault_;
  language_model::ScriptedModel model_{[this](const std::string& prompt) { return reply(prompt); },
                                       clock_};
  encounter::Setup setup_;
  Silence quiet_;
};

TEST_F(ReviewTest, IsHeardJudgedAndRecorded) {
  Record record = run(setup_, quiet_).value();
  std::string heard;
  const auto found = review(setup_, record, [&](std::string_view text) { heard += text; });
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_TRUE(found.value().has_value());
  EXPECT_EQ(heard, words_);
  EXPECT_EQ(found.value()->text, words_);
  // By hindsight: doing nothing meets him, a swerve can be driven.
  EXPECT_EQ(found.value()->truth.num_checked, 2);
  ASSERT_EQ(found.value()->truth.wrong.size(), 1U);
  EXPECT_THAT(found.value()->truth.wrong[0].text, HasSubstr("AES-L"));
  EXPECT_THAT(found.value()->prompt, HasSubstr("\n7 NI: hits pedestrian1 with its front at "));
  record.review = found.value();
  const auto out = nlohmann::json::parse(record_json(setup_, record));
  EXPECT_EQ(out["review"]["text"], words_);
  EXPECT_EQ(out["review"]["truth"]["checked"], 2);
  EXPECT_EQ(out["review"]["explanation"]["from"], "facts") << "its last statement is wrong";
  EXPECT_EQ(out["review"]["explanation"]["tries"], language_model::most_tries);
}

TEST_F(ReviewTest, QuotesWhatTookThePlaceOfThePlan) {
  Record record = run(setup_, quiet_).value();
  record.decision->plan = {manoeuvre::PolicyId::no_intervention, std::nullopt};
  record.switches = {{.time = 3.0, .change = {.plan = manoeuvre::full_braking}}};
  const auto found = review(setup_, record, [](std::string_view) {});
  ASSERT_TRUE(found.has_value() && found.value());
  EXPECT_THAT(found.value()->prompt, HasSubstr("7 NI, then 0 AEB: "));
}

TEST_F(ReviewTest, OfNothingIsNone) {
  Record record = run(setup_, quiet_).value();
  setup_.model = nullptr;
  EXPECT_FALSE(review(setup_, record, [](std::string_view) {}).value().has_value());
  EXPECT_TRUE(nlohmann::json::parse(record_json(setup_, record))["review"].is_null());
  setup_.model = &model_;
  record.decision.reset();
  EXPECT_FALSE(review(setup_, record, [](std::string_view) {}).value().has_value());
}

TEST_F(ReviewTest, TellsWhyThereIsNone) {
  const Record record = run(setup_, quiet_).value();
  fault_ = Error{Error::Code::unreadable, "the model is gone"};
  EXPECT_EQ(review(setup_, record, [](std::string_view) {}).error().message, "the model is gone");
}

TEST_F(ReviewTest, WithdrawnIsNone) {
  const Record record = run(setup_, quiet_).value();
  std::stop_source stop;
  const auto found = review(
      setup_, record, [&](std::string_view) { stop.request_stop(); }, stop.get_token());
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Error::Code::too_late);
}

}  // namespace
}  // namespace saca::encounter::review_test
