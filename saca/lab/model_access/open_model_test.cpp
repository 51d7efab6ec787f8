#include "saca/lab/model_access/open_model.h"

#include <gmock/gmock.h>

#include "saca/lab/model_access/sources_for_test.h"

namespace saca::model_access::open_model_test {
namespace {

using runtime::Pace;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class AModel : public SourcesFolder {
 protected:
  SteadyClock clock_;

  [[nodiscard]] Error refused(const ModelSources& with, const std::string& choice) {
    return open_model(with, choice, Pace::lockstep, clock_).error();
  }
  [[nodiscard]] std::string arguments() const {
    return read_file(folder_ / "host.arguments").value();
  }
};

TEST_F(AModel, OfThisMachineRunsInItsOwnProcessWithItsTemperature) {
  const auto model = open_model(sources(), "local", Pace::real, clock_);
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_THAT(model.value()->description(), HasSubstr("mine.gguf "));
  EXPECT_EQ(arguments(), "--model " + (folder_ / "mine.gguf").string() +
                             " --temperature 2.5 --flash-attention --give-way ");
}

TEST_F(AModel, InLockstepDoesNotGiveWay) {
  ASSERT_TRUE(open_local_model(sources(), Pace::lockstep, clock_).has_value());
  EXPECT_THAT(arguments(), testing::EndsWith("--flash-attention "));
}

TEST_F(AModel, OfOtherWeightsIsNamedByTheirFile) {
  const auto model =
      open_model(sources(), "local:" + (folder_ / "other.gguf").string(), Pace::lockstep, clock_);
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_THAT(model.value()->description(), HasSubstr("other.gguf "));
  EXPECT_THAT(arguments(), HasSubstr("--temperature 1 "));
}

TEST_F(AModel, ThatIsMissingTellsHowToGetIt) {
  ModelSources without = sources();
  without.host = folder_ / "nobody";
  EXPECT_THAT(refused(without, "local").message,
              AllOf(HasSubstr("nobody"), HasSubstr("make build")));
  without = sources();
  without.choice = folder_ / "nothing.json";
  EXPECT_THAT(refused(without, "local").message,
              AllOf(HasSubstr("nothing.json"), HasSubstr("`make model` gets it")));
  without = sources();
  without.harm = "nowhere.toml";
  EXPECT_THAT(refused(without, "local").message, HasSubstr("nowhere.toml"));
}

TEST_F(AModel, ThatDiesAtOnceIsRefused) {
  write("host", "#!/bin/sh\nexit 1\n");
  EXPECT_FALSE(open_model(sources(), "local", Pace::lockstep, clock_).has_value());
}

TEST_F(AModel, OfRepliesSaysWhatWasRecorded) {
  const auto model = open_model(sources(), "replay:" + (folder_ / "replies.json").string(),
                                Pace::lockstep, clock_);
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_THAT(model.value()->description(), StartsWith("replay of m ("));
  EXPECT_THAT(refused(sources(), "replay:none.json").message, HasSubstr("none.json"));
  EXPECT_THAT(refused(sources(), "replay:" + (folder_ / "mine.gguf").string()).message,
              HasSubstr("mine.gguf"));
}

TEST_F(AModel, OfAServerHasItsAddressChecked) {
  const auto model = open_model(sources(), "big@https://host/v1", Pace::lockstep, clock_);
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_EQ(model.value()->description(), "big at https://host/v1");
  ModelSources with_key = sources();
  with_key.key = "secret";
  const Error problem = refused(with_key, "big@http://host/v1");  // the key would be readable
  EXPECT_EQ(problem.code, Error::Code::malformed);
  EXPECT_THAT(problem.message, StartsWith("--llm: "));
  EXPECT_THAT(problem.message, testing::Not(HasSubstr("secret")));
}

TEST_F(AModel, ThatIsOffIsNoneAndAnyOtherWordIsRefused) {
  EXPECT_EQ(open_model(sources(), "off", Pace::real, clock_).value(), nullptr);
  EXPECT_EQ(refused(sources(), "lokal").message,
            "--llm: want local, local:FILE, off, replay:FILE or MODEL@URL, got `lokal`");
  EXPECT_EQ(refused(sources(), "@http://host").code, Error::Code::malformed);
}

TEST_F(AModel, ThatIsNeededMustNotBeOffAndItsOptionIsNamed) {
  const auto needed = [&](const std::string& choice, std::string_view option) {
    return open_needed_model(sources(), choice, Pace::lockstep, clock_, option).error().message;
  };
  EXPECT_EQ(needed("off", "--untuned"), "--untuned: want a language model to ask, got `off`");
  EXPECT_THAT(needed("lokal", "--untuned"), StartsWith("--untuned: want local, "));
  EXPECT_THAT(needed("lokal", "--llm"), StartsWith("--llm: want local, "));
  EXPECT_THAT(needed("replay:none.json", "--untuned"), StartsWith("--untuned: none.json"));
  EXPECT_THAT(needed("replay:none.json", "--llm"), StartsWith("none.json"));
  EXPECT_TRUE(open_needed_model(sources(), "local", Pace::lockstep, clock_, "--llm").has_value());
}

}  // namespace
}  // namespace saca::model_access::open_model_test
