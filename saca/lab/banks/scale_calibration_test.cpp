#include "saca/lab/banks/scale_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/clock.h"
#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::scale_calibration_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Not;

class ScaleCalibrationTest : public testing::Test {
 protected:
  ManualClock clock_;
  long_work::ProgressLine progress_{"scales", 0, clock_, long_work::ProgressDisplay::silent};
};

/// What policies harm follows from the speed.
memory::Case harm_by_speed(double speed, const std::string& source) {
  memory::Case one = best_is(PolicyId::aeb, speed, source);
  one.told->fill(0.02 * speed);
  return one;
}

TEST_F(ScaleCalibrationTest, IsHeldAgainstOtherCases) {
  CalibrationCases cases{.file = "cases.jsonl", .cases = {}, .check_files = {}, .check_cases = {}};
  for (int k = 0; k < 30; ++k) {
    cases.cases.push_back(harm_by_speed(10.0 + 0.5 * k, "case" + std::to_string(k)));
  }
  cases.check_files = {"check.jsonl"};
  cases.check_cases = {harm_by_speed(12.25, "other")};
  const auto calibration = calibrate_scales(cases, {.scenes = 10, .threads = 2}, progress_);
  ASSERT_TRUE(calibration.has_value());
  const eval::ScaleFit& fit = calibration.value().fit;
  EXPECT_TRUE(fit.is_done);
  EXPECT_LE(fit.error, fit.error_before);
  ASSERT_TRUE(calibration.value().check);
  EXPECT_DOUBLE_EQ(calibration.value().check->shipped,
                   *eval::scale_error(cases.cases, cases.check_cases, {}, 1));
  EXPECT_DOUBLE_EQ(calibration.value().check->fitted,
                   *eval::scale_error(cases.cases, cases.check_cases, fit.scales, 1));
}

TEST_F(ScaleCalibrationTest, WantsCasesThatTellWhatWasExpected) {
  CalibrationCases cases{.file = "cases.jsonl",
                         .cases = {harm_by_speed(10.0, "a"), harm_by_speed(11.0, "b")},
                         .check_files = {},
                         .check_cases = {}};
  EXPECT_FALSE(calibrate_scales(cases, {}, progress_).value().check) << "nothing is to be checked";
  for (memory::Case& one : cases.cases) {
    one.told.reset();
  }
  const auto untold = calibrate_scales(cases, {}, progress_);
  ASSERT_FALSE(untold.has_value());
  EXPECT_EQ(untold.error().code, Error::Code::malformed);
  EXPECT_EQ(untold.error().message,
            "cases.jsonl: want cases that tell what every policy was expected to harm, got none");
}

ScaleCalibration example() {
  ScaleCalibration calibration;
  calibration.fit.error_before = 0.25;
  calibration.fit.error = 0.125;
  calibration.fit.is_done = true;
  calibration.fit.scales.speed = 2.0 * match::Scales{}.speed;
  calibration.check = CheckError{.shipped = 0.5, .fitted = 0.375};
  return calibration;
}

TEST_F(ScaleCalibrationTest, IsPrintedForPrograms) {
  ScaleCalibration calibration = example();
  const nlohmann::json out = json_of(calibration, "1.2.3");
  EXPECT_EQ(out.at("meta.command"), "saca memory calibrate CASES --fit");
  EXPECT_EQ(out.at("meta.version"), "1.2.3");
  EXPECT_EQ(out.at("memory.scales.is_done"), true);
  EXPECT_EQ(out.at("memory.scales.error.shipped"), 0.25);
  EXPECT_EQ(out.at("memory.scales.error.fitted"), 0.125);
  EXPECT_EQ(out.at("memory.scales.speed.shipped"), match::Scales{}.speed);
  EXPECT_EQ(out.at("memory.scales.speed.fitted"), 2.0 * match::Scales{}.speed);
  EXPECT_EQ(out.at("memory.scales.room.fitted"), match::Scales{}.to_edge);
  EXPECT_EQ(out.at("memory.scales.check_error.shipped"), 0.5);
  EXPECT_EQ(out.at("memory.scales.check_error.fitted"), 0.375);
  calibration.check.reset();
  EXPECT_FALSE(json_of(calibration, "").contains("memory.scales.check_error.shipped"));
}

TEST_F(ScaleCalibrationTest, IsPrintedForPeople) {
  ScaleCalibration calibration = example();
  const std::string text = text_of(calibration);
  EXPECT_THAT(text, testing::StartsWith("\nscale           shipped   fitted\nspeed "));
  EXPECT_THAT(text, testing::EndsWith("error of the harm predicted by like cases: 0.2500, fitted "
                                      "0.1250\nin the cases to check: 0.5000, fitted 0.3750\n"));
  calibration.check.reset();
  EXPECT_THAT(text_of(calibration), Not(HasSubstr("to check")));
}

}  // namespace
}  // namespace saca::banks::scale_calibration_test
