#include "saca/lab/policy_study/survey_inputs.h"

#include <gmock/gmock.h>

#include <string>

#include "saca/base/core/file.h"

namespace saca::policy_study::survey_inputs_test {
namespace {

namespace fs = std::filesystem;

class SurveyInputs : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* file :
         {"car.toml", "car.tuning.toml", "data/cues.toml", "data/harm.toml",
          "data/thinking_costs.toml", "scenarios/splits.toml", "scenarios/families/one.toml"}) {
      write(file, "as it was");
    }
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    ASSERT_EQ(write_file(root_ / file, text), std::nullopt);
  }
  [[nodiscard]] std::uint64_t digest() const {
    Fnv hash;
    EXPECT_EQ(add_survey_inputs(root_, root_ / "car.toml", hash), std::nullopt);
    return hash.value();
  }

  const fs::path root_ = fs::path(testing::TempDir()) / "survey_inputs";
};

TEST_F(SurveyInputs, EveryFileThatCountsChangesTheDigest) {
  const std::uint64_t before = digest();
  EXPECT_EQ(digest(), before);
  for (const char* file :
       {"car.toml", "car.tuning.toml", "data/cues.toml", "data/harm.toml",
        "data/thinking_costs.toml", "scenarios/splits.toml", "scenarios/families/one.toml"}) {
    write(file, "otherwise");
    EXPECT_NE(digest(), before) << file;
    write(file, "as it was");
  }
  write("scenarios/families/README.md", "no family");
  EXPECT_EQ(digest(), before);
  write("scenarios/families/two.toml", "one more");
  EXPECT_NE(digest(), before);
}

TEST_F(SurveyInputs, WhatCannotBeReadIsNamed) {
  fs::remove(root_ / "car.tuning.toml");
  Fnv hash;
  const auto problem = add_survey_inputs(root_, root_ / "car.toml", hash);
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::unreadable);
  EXPECT_THAT(problem->message, testing::HasSubstr("car.tuning.toml"));
}

}  // namespace
}  // namespace saca::policy_study::survey_inputs_test
