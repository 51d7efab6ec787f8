#include "saca/lab/family_samples/showcase_json.h"

#include <gtest/gtest.h>

namespace saca::family_samples::showcase_json_test {
namespace {

using manoeuvre::index;
using manoeuvre::PolicyId;

TEST(ShowcaseJson, SaysByHowMuchThePolicyIsAlone) {
  ShowcaseScene one;
  one.scenario.name = "showcase_2";
  one.scenario.why = "It is right.";
  one.oracle.ranking = {PolicyId::aes_right, PolicyId::aeb};
  one.oracle.verdicts[index(PolicyId::aeb)].behind = {0.25, 0.125, 0.375};
  const nlohmann::json out = json_of(one, PolicyId::aes_right);
  EXPECT_EQ(out["policy"], index(PolicyId::aes_right));
  EXPECT_EQ(out["scenario"], "showcase_2");
  EXPECT_EQ(out["why"], "It is right.");
  EXPECT_EQ(out["margin"], 0.25);
  EXPECT_EQ(out["margin_low"], 0.125);
  EXPECT_EQ(out.size(), 5U);
}

}  // namespace
}  // namespace saca::family_samples::showcase_json_test
