#include "saca/lab/runs/run_means.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/lab/installation/here_for_test.h"

namespace saca::runs::run_means_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RunMeansTest : public testing::Test {
 protected:
  RunMeansTest() {
    here_.notice = [this](const std::string& what) { noticed_.push_back(what); };
    fs::remove_all(request_.output);
  }
  ~RunMeansTest() override { fs::remove_all(request_.output); }

  [[nodiscard]] std::string problem() {
    const auto opened = open_means(here_, request_, clock_);
    return opened.has_value() ? "" : opened.error().message;
  }

  SteadyClock clock_;
  std::vector<std::string> noticed_;
  installation::Installation here_ = installation::here_for_test();
  RunRequest request_{.scenario = "one_way",
                      .pace = "lockstep",
                      .model = "off",
                      .atlas = "off",
                      .danger = "off",
                      .output = (fs::path(testing::TempDir()) / "run_means").string(),
                      .command = "saca run one_way",
                      .date = "2026-01-02T03:04:05Z"};
};

TEST_F(RunMeansTest, AreWhatTheRequestNames) {
  request_.trigger = "t1";
  request_.seed = 3;
  request_.tape = (fs::path(request_.output) / "tape").string();
  const auto opened = open_means(here_, request_, clock_);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  const RunMeans& means = *opened.value();
  EXPECT_EQ(means.provenance.program, "saca 1.2.3");
  EXPECT_EQ(means.provenance.commit, "abc");
  EXPECT_EQ(means.provenance.date, "2026-01-02T03:04:05Z");
  EXPECT_EQ(means.provenance.digest.size(), 16U);
  const encounter::Setup setup = setup_of(means, request_, clock_);
  EXPECT_EQ(setup.scenario->name, "one_way");
  EXPECT_EQ(setup.pace, runtime::Pace::lockstep);
  EXPECT_FALSE(setup.thresholds.waiting_cost.has_value());
  EXPECT_EQ(setup.seed, 3U);
  EXPECT_TRUE(setup.tapes);
  EXPECT_EQ(setup.atlas, nullptr);
  EXPECT_EQ(setup.danger, nullptr);
  EXPECT_EQ(setup.memory, nullptr);
  EXPECT_EQ(setup.model, nullptr);
  EXPECT_TRUE(setup.learns);
  EXPECT_THAT(noticed_, IsEmpty());
}

TEST_F(RunMeansTest, AModelThatIsNotThereIsDoneWithout) {
  request_.model = "local";
  const auto opened = open_means(here_, request_, clock_);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  EXPECT_EQ(opened.value()->model.get(), nullptr);
  EXPECT_THAT(noticed_, ElementsAre(HasSubstr("make model"), "going on as with --llm off"));
}

TEST_F(RunMeansTest, AMemoryIsMadeWithItsFirstCases) {
  fs::create_directories(request_.output);
  request_.memory = (fs::path(request_.output) / "bank.sqlite").string();
  request_.empty_memory = true;
  EXPECT_EQ(problem(), "");
  EXPECT_TRUE(fs::exists(request_.memory));
  fs::remove(request_.memory);
  request_.no_learning = true;  // to ask one that is not there
  EXPECT_THAT(problem(), HasSubstr("bank.sqlite"));
}

TEST_F(RunMeansTest, WhatCannotBeUsedIsTold) {
  request_.atlas = "none.atlas";
  EXPECT_THAT(problem(), HasSubstr("none.atlas"));
  EXPECT_THAT(problem(), HasSubstr("--atlas off does without"));
  request_.atlas = "off";
  request_.forced = {.policy = manoeuvre::PolicyId::aeb, .target_speed = 5.0};
  EXPECT_THAT(problem(), HasSubstr("--target-speed"));
  request_.forced = {};
  request_.scenario = "one_wya";
  EXPECT_THAT(problem(), HasSubstr("one_way"));
  request_.scenario = "one_way";
  request_.output = "/proc/nowhere";
  EXPECT_THAT(problem(), HasSubstr("/proc/nowhere"));
}

TEST_F(RunMeansTest, FilesLieBesideTheRecordUnlessNamed) {
  const RunFiles files = files_of({.output = "runs"}, "one_way");
  EXPECT_EQ(files.record, "runs/one_way/record.json");
  EXPECT_EQ(files.report, "runs/one_way/report.html");
  EXPECT_TRUE(files.trace.empty());
  EXPECT_EQ(files_of({.report = "a.html"}, "one_way").report, "a.html");
}

}  // namespace
}  // namespace saca::runs::run_means_test
