#include "saca/onboard/manoeuvre/tuning.h"

#include <gtest/gtest.h>

namespace saca::manoeuvre::tuning_test {
namespace {

TEST(DriftDomain, IsALineBetweenItsGrips) {
  const DriftDomain domain{.slowest = {20.0, 15.0, 11.0, 10.0, 9.0, 8.0},
                           .fastest = {22.0, 24.0, 25.0, 25.0, 25.0, 25.0}};
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 0.2).slowest, 20.0);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 0.25).slowest, 17.5);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 0.25).fastest, 23.0);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 0.7).slowest, 10.0);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 1.0).slowest, 8.0);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 0.1).slowest, 20.0);
  EXPECT_DOUBLE_EQ(drift_speeds(domain, 1.1).slowest, 8.0);
}

TEST(DriftDomain, IsEmptyBesideAGripWhereNothingWorks) {
  const DriftDomain domain{.slowest = {25.0, 15.0, 11.0, 10.0, 9.0, 8.0},
                           .fastest = {0.0, 24.0, 25.0, 25.0, 25.0, 25.0}};
  EXPECT_GT(drift_speeds(domain, 0.28).slowest, drift_speeds(domain, 0.28).fastest);
  EXPECT_LT(drift_speeds(domain, 0.3).slowest, drift_speeds(domain, 0.3).fastest);
}

}  // namespace
}  // namespace saca::manoeuvre::tuning_test
