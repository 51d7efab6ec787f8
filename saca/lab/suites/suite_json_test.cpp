#include "saca/lab/suites/suite_json.h"

#include <gmock/gmock.h>

#include "saca/lab/suites/rows_for_test.h"

namespace saca::suites::suite_json_test {
namespace {

using nlohmann::json;

SuiteRequest request_of(const std::string& name) {
  SuiteRequest request;
  request.name = name;
  request.threads = 2;
  return request;
}

json document(const SuiteRun& run, const std::string& name) {
  return json_of(run, result_of(run, 1), request_of(name));
}

TEST(SuiteJson, HasFiguresOfMethodsOverAllAndByFamily) {
  SuiteRun run =
      made_run({"saca", "aeb"}, {made_row(0, "a", {0.3, 0.5}, 0.1),
                                 made_row(1, "a", {0.3, 0.5}, 0.1), failed_row(2, "b", "no road")});
  run.worked = 3;
  run.seconds = 1.5;
  const json out = document(run, "folder/natural");
  EXPECT_EQ(out.at("meta.command"), "saca suite made");
  EXPECT_NEAR(out.at("suite.natural.saca.harm").get<double>(), 0.3, 1e-12);
  EXPECT_EQ(out.at("suite.natural.saca.harm.n"), 2);
  EXPECT_NEAR(out.at("suite.natural.saca.a.regret").get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(out.at("suite.natural.saca.regret_over_aeb").get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(out.at("suite.natural.saca.harm_over_aeb").get<double>(), -0.2, 1e-12);
  EXPECT_NEAR(out.at("suite.natural.aeb.harm_over_first").get<double>(), 0.2, 1e-12);
  EXPECT_EQ(out.at("suite.natural.aeb.faults"), 0);
  EXPECT_EQ(out.at("suite.natural.n"), 3);
  EXPECT_EQ(out.at("suite.natural.faults"), 1);
  EXPECT_EQ(out.at("suite.natural.encounters_per_s"), 2.0);
  EXPECT_EQ(out.at("suite.natural.encounters_per_s_core"), 1.0);
  EXPECT_FALSE(out.contains("suite.natural.saca.b.harm"));
  EXPECT_FALSE(out.contains("suite.natural.saca.expected"));
  EXPECT_FALSE(out.contains("suite.natural.driver.n"));
}

TEST(SuiteJson, WhatWasReadFromAJournalHasNoRate) {
  const json out = document(made_run({"aeb"}, {made_row(0, "a", {0.0}, 0.0)}), "natural");
  EXPECT_FALSE(out.contains("suite.natural.encounters_per_s"));
  EXPECT_FALSE(out.contains("suite.natural.threads"));
  EXPECT_FALSE(out.contains("suite.natural.aeb.regret_over_aeb"));  // braking loses nothing
}

TEST(SuiteJson, HasRecordedDrivers) {
  SuiteRun run = made_run({"aeb"}, {made_row(0, "a", {0.0}, 0.0)});
  run.rows[0].driver = eval::DriverRow{.harm = 0.25, .brakes = true};
  const json out = document(run, "100car");
  EXPECT_EQ(out.at("suite.100car.driver.n"), 1);
  EXPECT_EQ(out.at("suite.100car.driver.harm"), 0.25);
  EXPECT_EQ(out.at("suite.100car.driver.braked"), 1);
  EXPECT_EQ(out.at("suite.100car.aeb.agrees_with_driver"), 1.0);
}

}  // namespace
}  // namespace saca::suites::suite_json_test
