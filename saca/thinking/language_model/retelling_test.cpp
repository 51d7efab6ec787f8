#include "saca/thinking/language_model/retelling.h"

#include <gmock/gmock.h>

#include <vector>

#include "saca/thinking/language_model/scripted_model.h"

namespace saca::language_model::retelling_test {
namespace {

using From = Explanation::From;

/// The model says what `replies_` are, one after the other; what begins with "true" holds, an empty
/// one holds no answer.
class RetellingTest : public testing::Test {
 protected:
  Result<Explanation> told_or_error(From first = From::facts) {
    return told_again(model_, clock_, "the prompt", {.text = "at first", .from = first},
                      [](std::string_view written) {
                        return written.starts_with("true")
                                   ? Explanation{std::string(written), From::model}
                                   : Explanation{"the facts", From::facts};
                      },
                      {.stop = stop_.get_token()});
  }
  Explanation told(From first = From::facts) { return told_or_error(first).value(); }
  ScriptedReply next() {
    const auto at = static_cast<std::size_t>(model_.num_asked() - 1);
    if (at < replies_.size() && replies_[at].empty()) {
      return {.error = Error{Error::Code::malformed, "no answer in it"}};
    }
    return at < replies_.size()
               ? ScriptedReply{.lines = {{.text = replies_[at], .answer = Answer::Kind::ended}}}
               : ScriptedReply{.error = Error{Error::Code::unreadable, "it is gone"}};
  }

  ManualClock clock_;
  std::stop_source stop_;
  std::vector<std::string> replies_;
  ScriptedModel model_{[this](const std::string&) { return next(); }, clock_};
};

TEST_F(RetellingTest, OwnWordsThatHoldAreKept) {
  replies_ = {"true, but nobody asks"};
  for (const From from : {From::model, From::model_in_part}) {
    const Explanation telling = told(from);
    EXPECT_EQ(telling.text, "at first");
    EXPECT_EQ(telling.tries, 1);
  }
  EXPECT_EQ(model_.num_asked(), 0);
}

TEST_F(RetellingTest, AsksUntilItHolds) {
  replies_ = {"true at last", "never heard"};
  EXPECT_EQ(told().text, "true at last");
  EXPECT_EQ(model_.num_asked(), 1);
  EXPECT_EQ(model_.last_scenes(), std::vector<std::string>{"the prompt"});
}

TEST_F(RetellingTest, ThreeTriesThenTheFacts) {
  replies_ = {"false", "false again", "true, too late"};
  const Explanation telling = told();
  EXPECT_EQ(telling.from, From::facts);
  EXPECT_EQ(telling.tries, most_tries);
  EXPECT_EQ(model_.num_asked(), most_tries - 1);
}

// Greedy, the same words would come again.
TEST_F(RetellingTest, EachTryHasASeedOfItsOwn) {
  class Seeds final : public LanguageModel {
   public:
    [[nodiscard]] std::string description() const override { return "seeds"; }
    std::vector<int> seen;

   private:
    Result<std::vector<Reply>> reply_to(const std::vector<std::string>&, Clock::Time,
                                        const std::function<void(const Progress&)>&,
                                        const AskOptions& options) override {
      seen.push_back(options.sampling_seed);
      return std::vector<Reply>{{.reasoning = "1. No.", .answers = {{}}}};
    }
  } seeds;
  (void)told_again(seeds, clock_, "p", {}, [](std::string_view) { return Explanation{}; });
  EXPECT_THAT(seeds.seen, testing::ElementsAre(1, 2));
}

TEST_F(RetellingTest, NonsenseIsATryLikeOthers) {
  replies_ = {"", "true"};
  const Explanation telling = told();
  EXPECT_EQ(telling.text, "true");
  EXPECT_EQ(telling.tries, most_tries);
}

TEST_F(RetellingTest, AModelThatIsGoneIsTold) {
  EXPECT_EQ(told_or_error().error().message, "it is gone");
}

TEST_F(RetellingTest, WithdrawnLeavesWhatWasShown) {
  replies_ = {"true"};
  stop_.request_stop();
  EXPECT_EQ(told().text, "at first");
}

}  // namespace
}  // namespace saca::language_model::retelling_test
