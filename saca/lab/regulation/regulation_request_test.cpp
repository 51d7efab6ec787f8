#include "saca/lab/regulation/regulation_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::regulation::regulation_request_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const RegulationRequest aeb_in_r152{.name = "r152",
                                    .methods = "aeb,nothing",
                                    .cars = "compact_rwd_ev",
                                    .rows = "stopped_lead",
                                    .threads = 1};

TEST(RegulationRequest, IsPlayedWithItsCarsRowsAndMethods) {
  const auto run = run_regulation(installation::here_for_test(), aeb_in_r152, {"aeb", "nothing"});
  ASSERT_TRUE(run.has_value()) << run.error().message;
  ASSERT_TRUE(run.value().has_value());
  EXPECT_EQ(run.value()->cars, std::vector<std::string>{"compact_rwd_ev"});
  EXPECT_EQ(run.value()->regulation.rows.size(), 1U);
  EXPECT_EQ(run.value()->meta.at("meta.command"),
            "saca suite r152 --methods aeb,nothing --car compact_rwd_ev --rows stopped_lead");
  // UN R152 wants every one of these passed; who does nothing passes none.
  const PassCount aeb = passed_by(*run.value(), {.method = 0});
  EXPECT_EQ(aeb.passed, aeb.all);
  EXPECT_EQ(passed_by(*run.value(), {.method = 1}).passed, 0);
}

TEST(RegulationRequest, WhatIsNotThereIsTold) {
  const auto message = [](RegulationRequest request) {
    return run_regulation(installation::here_for_test(), request, {"aeb"}).error().message;
  };
  RegulationRequest request = aeb_in_r152;
  request.rows = "stoped_lead";
  EXPECT_THAT(message(request), AllOf(HasSubstr("--rows: "), HasSubstr("stopped_lead")));
  request = aeb_in_r152;
  request.cars = "compact_rwd_ev,none";
  EXPECT_THAT(message(request), HasSubstr("none: no car"));
  request = aeb_in_r152;
  request.name = "r999";
  EXPECT_THAT(message(request), HasSubstr("r999.toml"));
}

}  // namespace
}  // namespace saca::regulation::regulation_request_test
