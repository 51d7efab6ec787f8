#include "saca/lab/model_access/chosen_model.h"

#include <gmock/gmock.h>

#include "saca/lab/model_access/sources_for_test.h"

namespace saca::model_access::chosen_model_test {
namespace {

using runtime::Pace;
using testing::HasSubstr;

class AChosenModel : public SourcesFolder {
 protected:
  SteadyClock clock_;
  [[nodiscard]] Result<ChosenModel> open(const ModelSources& with, const std::string& choice,
                                         const std::string& record = "") {
    return ChosenModel::open(with, choice, record, Pace::lockstep, clock_);
  }
};

TEST_F(AChosenModel, MayBeOff) {
  const auto off = open(sources(), "off", folder_ / "replies_of_none.json");
  ASSERT_TRUE(off.has_value());
  EXPECT_EQ(off.value().get(), nullptr);
  EXPECT_FALSE(off.value().missing().has_value());
  EXPECT_EQ(off.value().save_replies(), std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "replies_of_none.json"));
}

TEST_F(AChosenModel, MayBeMissingWhereItIsTheUsualOneOnly) {
  ModelSources without = sources();
  without.choice = folder_ / "nothing.json";
  const auto local = open(without, "local");
  ASSERT_TRUE(local.has_value());
  EXPECT_EQ(local.value().get(), nullptr);
  ASSERT_TRUE(local.value().missing().has_value());
  EXPECT_THAT(local.value().missing()->message, HasSubstr("nothing.json"));
  EXPECT_THAT(open(sources(), "replay:none.json").error().message, HasSubstr("none.json"));
}

TEST_F(AChosenModel, HasItsRepliesWrittenDownWhereThatIsWanted) {
  const std::string replay = "replay:" + (folder_ / "replies.json").string();
  const auto plain = open(sources(), replay);
  ASSERT_TRUE(plain.has_value());
  EXPECT_EQ(plain.value().save_replies(), std::nullopt);
  const auto recorded = open(sources(), replay, folder_ / "said.json");
  ASSERT_TRUE(recorded.has_value());
  EXPECT_EQ(recorded.value().get()->description(), plain.value().get()->description());
  ASSERT_EQ(recorded.value().save_replies(), std::nullopt);
  const auto said = language_model::parse_replies(read_file(folder_ / "said.json").value(), "x");
  ASSERT_TRUE(said.has_value());
  EXPECT_EQ(said.value().model, plain.value().get()->description());
}

}  // namespace
}  // namespace saca::model_access::chosen_model_test
