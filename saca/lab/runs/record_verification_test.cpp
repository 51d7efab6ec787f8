#include "saca/lab/runs/record_verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/installation/here_for_test.h"
#include "saca/lab/runs/run_means.h"

namespace saca::runs::record_verification_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// The record of a run, made once for all tests.
std::string some_record() {
  static const std::string text = [] {
    SteadyClock clock;
    const RunRequest request{.scenario = "one_way",
                             .pace = "lockstep",
                             .model = "off",
                             .atlas = "off",
                             .danger = "off",
                             .output = (fs::path(testing::TempDir()) / "verification").string()};
    const auto means = open_means(installation::here_for_test(), request, clock);
    const encounter::Setup setup = setup_of(*means.value(), request, clock);
    encounter::Silence nobody;
    encounter::Record record = encounter::run(setup, nobody).value();
    return encounter::record_json(setup, record, &means.value()->provenance);
  }();
  return text;
}

Result<encounter::RecordCheck> verified_text(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "verified.json";
  EXPECT_EQ(write_file(file, text), std::nullopt);
  return verified(installation::here_for_test(), file.string());
}

TEST(RecordVerification, ARecordOfTodayIsTheSame) {
  const auto check = verified_text(some_record());
  ASSERT_TRUE(check.has_value()) << check.error().message;
  EXPECT_TRUE(check.value().is_unchanged());
  EXPECT_TRUE(check.value().is_same());
}

TEST(RecordVerification, ChangedContentAndOtherInputsAreFound) {
  json record = json::parse(some_record());
  record["scenario"]["title"] = "Another one.";
  EXPECT_FALSE(verified_text(record.dump()).value().is_unchanged());
  record = json::parse(some_record());
  record["made"]["inputs"][0]["digest"] = "0000000000000000";
  const auto other = verified_text(record.dump());
  EXPECT_FALSE(other.value().is_same());
}

TEST(RecordVerification, WhatIsNoWholeRecordIsRefused) {
  EXPECT_THAT(verified(installation::here_for_test(), "nowhere.json").error().message,
              HasSubstr("nowhere.json"));
  EXPECT_FALSE(verified_text("{}").has_value());
  json record = json::parse(some_record());
  record.erase("made");
  EXPECT_THAT(verified_text(record.dump()).error().message,
              HasSubstr("made: want who made the record by what"));
  record = json::parse(some_record());
  record["made"] = json::object({{"inputs", 3}});
  EXPECT_THAT(verified_text(record.dump()).error().message, HasSubstr("made: want it whole"));
}

}  // namespace
}  // namespace saca::runs::record_verification_test
