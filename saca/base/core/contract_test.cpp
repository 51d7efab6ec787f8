#include "saca/base/core/contract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace saca::contract_test {
namespace {

using testing::HasSubstr;

void drive(double speed) {
  expects(speed >= 0.0, "speed >= 0");
}

TEST(Expects, IsSilentWhenTheRuleHolds) {
  EXPECT_NO_THROW(drive(0.0));
}

TEST(Expects, NamesTheRuleAndTheFunction) {
  try {
    drive(-1.0);
    FAIL() << "a negative speed was accepted";
  } catch (const ContractViolation& violation) {
    EXPECT_THAT(violation.what(), HasSubstr("speed >= 0"));
    EXPECT_THAT(violation.what(), HasSubstr("drive"));
  }
}

TEST(Expects, RefusesNaN) {
  EXPECT_THROW(drive(std::numeric_limits<double>::quiet_NaN()), ContractViolation);
}

}  // namespace
}  // namespace saca::contract_test
