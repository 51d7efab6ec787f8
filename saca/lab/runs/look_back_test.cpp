#include "saca/lab/runs/look_back.h"

#include <gmock/gmock.h>

#include "saca/lab/runs/walker_for_test.h"
#include "saca/thinking/language_model/scripted_model.h"

namespace saca::runs::look_back_test {
namespace {

using testing::HasSubstr;

/// A model that brakes where it is asked, and looks back with these words.
class LookingBack : public testing::Test {
 protected:
  language_model::ScriptedReply reply(const std::string& prompt) const {
    if (!prompt.starts_with("# Review")) {
      return {.lines = {{.answer = language_model::Answer::Kind::first}}};
    }
    return fault_ ? language_model::ScriptedReply{.error = fault_}
                  : language_model::ScriptedReply{
                        .lines = {{.text = "1. NI hits pedestrian1.\n2. AES-L is not possible.",
                                   .answer = language_model::Answer::Kind::ended}}};
  }

  Walker walker_;
  std::optional<Error> fault_;
  language_model::ScriptedModel model_{[this](const std::string& prompt) { return reply(prompt); },
                                       walker_.clock};
  encounter::Silence quiet_;
  Story story_{std::nullopt, false};
};

TEST_F(LookingBack, IsRecordedWithWhatIsTrueOfIt) {
  walker_.setup.model = &model_;
  encounter::Record record = encounter::run(walker_.setup, quiet_).value();
  ASSERT_EQ(look_back(walker_.setup, record, story_), std::nullopt);
  ASSERT_TRUE(record.review.has_value());
  EXPECT_GE(record.review->truth.num_checked, 1);
  EXPECT_FALSE(record.stored.has_value());  // there is no memory to keep a lesson
  EXPECT_EQ(record.not_stored, std::nullopt);
}

TEST_F(LookingBack, OfAModelThatFailsTellsWhy) {
  walker_.setup.model = &model_;
  encounter::Record record = encounter::run(walker_.setup, quiet_).value();
  fault_ = Error{Error::Code::unreadable, "gone"};
  const auto problem = look_back(walker_.setup, record, story_);
  ASSERT_TRUE(problem.has_value());
  EXPECT_THAT(problem->message, HasSubstr("gone"));
  EXPECT_FALSE(record.review.has_value());
}

TEST_F(LookingBack, WithoutAModelIsNothing) {
  encounter::Record record = encounter::run(walker_.setup, quiet_).value();
  EXPECT_EQ(look_back_until_interrupted(walker_.setup, record, story_), std::nullopt);
  EXPECT_FALSE(record.review.has_value());
}

}  // namespace
}  // namespace saca::runs::look_back_test
