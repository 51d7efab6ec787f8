#include "saca/lab/policy_study/interruptible_survey.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::policy_study::interruptible_survey_test {
namespace {

namespace fs = std::filesystem;

class InterruptibleSurvey : public testing::Test {
 protected:
  [[nodiscard]] eval::SurveyWork work(int count, const fs::path& journal) const {
    return {.source = &source_,
            .car = &car_,
            .harm = &harm_,
            .count = count,
            .journal = journal,
            .title = "a test"};
  }

  const manoeuvre::Car car_ = prepare::default_car();
  const collision::HarmModel harm_ = eval::shipped_harm();
  const eval::SuiteSource source_ =
      eval::SuiteSource::open({.scenarios = "scenarios",
                               .suite = "crossing",
                               .test_log = std::nullopt,
                               .car = "compact_rwd_ev",
                               .footprint = manoeuvre::footprint(car_)})
          .value();
};

TEST_F(InterruptibleSurvey, FindsWhatTheSurveyFindsAndMakesItsFolder) {
  const fs::path folder = fs::path(testing::TempDir()) / "survey" / "deep";
  testing::internal::CaptureStderr();
  const auto found = interruptible_survey(work(1, folder / "a.journal"), "crossing",
                                          long_work::ProgressDisplay::shown)
                         .value();
  EXPECT_EQ(
      testing::internal::GetCapturedStderr().find("survey of crossing: 1 of at most 1 encounters"),
      0U);
  EXPECT_EQ(found, eval::survey(work(1, fs::path(testing::TempDir()) / "b.journal")).value());
  EXPECT_TRUE(fs::exists(folder / "a.journal"));
}

TEST_F(InterruptibleSurvey, AFolderThatCannotBeMadeIsAnError) {
  const fs::path file = fs::path(testing::TempDir()) / "a_file";
  ASSERT_EQ(write_file(file, "x"), std::nullopt);
  const auto found = interruptible_survey(work(1, file / "a.journal"), "crossing",
                                          long_work::ProgressDisplay::silent);
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::policy_study::interruptible_survey_test
