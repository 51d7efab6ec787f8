#include "saca/lab/eval/showcase.h"

#include <gmock/gmock.h>

namespace saca::eval::showcase_test {
namespace {

using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Finding found(std::uint64_t number, PolicyId best, double its_harm, double others_harm) {
  Finding finding{.family = "crossing", .number = number, .time = 5.0, .best = best};
  finding.harm.fill(others_harm);
  finding.harm[manoeuvre::index(best)] = its_harm;
  return finding;
}

std::vector<std::uint64_t> numbers(const std::vector<Finding>& findings) {
  std::vector<std::uint64_t> all;
  for (const Finding& finding : findings) {
    all.push_back(finding.number);
  }
  return all;
}

TEST(Showcase, TheWidestMarginIsTriedFirst) {
  const std::vector<Finding> findings{
      found(1, PolicyId::aes_left, 0.1, 0.2), found(2, PolicyId::aes_left, 0.1, 0.5),
      found(3, PolicyId::aeb, 0.0, 0.9), found(4, PolicyId::aes_left, 0.3, 0.3)};
  EXPECT_THAT(numbers(candidates(findings, PolicyId::aes_left)), ElementsAre(2, 1));
  EXPECT_THAT(candidates(findings, PolicyId::t_drift_left), IsEmpty());
  std::vector<Finding> with_contact = findings;
  with_contact[1].contact.fill(true);
  EXPECT_THAT(numbers(candidates(with_contact, PolicyId::aes_left)), ElementsAre(1, 2));
}

TEST(Showcase, DoingNothingIsShownWhereBrakingWouldHarmMost) {
  const std::vector<Finding> findings{found(1, PolicyId::no_intervention, 0.0, 0.1),
                                      found(2, PolicyId::no_intervention, 0.0, 0.4),
                                      found(3, PolicyId::no_intervention, 0.1, 0.4)};
  EXPECT_THAT(numbers(candidates(findings, PolicyId::no_intervention)), ElementsAre(2, 1));
}

/// Two that can be driven; the better has the harm 0.01, the other is `behind` it.
Oracle told(PolicyId best, PolicyId other, forecast::Mean behind) {
  Oracle oracle;
  oracle.ranking = {best, other};
  oracle.verdicts[manoeuvre::index(best)].expected.harm = {0.001, 0.0, 0.002};
  oracle.verdicts[manoeuvre::index(other)].expected.harm = {0.001 + behind.value, 0.0, 1.0};
  oracle.verdicts[manoeuvre::index(other)].behind = behind;
  return oracle;
}

TEST(Showcase, AClearMarginUnderNoiseConvinces) {
  const auto with = [](double value, double low) {
    return told(PolicyId::aes_left, PolicyId::aeb, {value, low, 1.0});
  };
  const ShowcaseRule rule{.clear = 0.005};
  EXPECT_TRUE(convinces(with(0.02, 0.01), PolicyId::aes_left, rule));
  EXPECT_FALSE(convinces(with(0.02, 0.01), PolicyId::aeb, rule));         // it is not the best
  EXPECT_FALSE(convinces(with(0.02, -0.01), PolicyId::aes_left, rule));   // noise may turn it round
  EXPECT_FALSE(convinces(with(0.004, 0.003), PolicyId::aes_left, rule));  // too little
}

TEST(Showcase, EveryOtherMustBeClearlyWorse) {
  Oracle three = told(PolicyId::aes_left, PolicyId::aeb, {0.02, 0.01, 0.03});
  three.ranking.push_back(PolicyId::t_drift_left);
  forecast::Mean& wide = three.verdicts[manoeuvre::index(PolicyId::t_drift_left)].behind;
  wide = {0.05, 0.02, 0.08};
  EXPECT_TRUE(convinces(three, PolicyId::aes_left, {}));
  wide = {0.05, -0.02, 0.12};
  EXPECT_FALSE(convinces(three, PolicyId::aes_left, {}));
}

TEST(Showcase, DoingNothingConvincesWhereItHarmsNobodyAndNobodyElseDoesLess) {
  const ShowcaseRule rule{.clear = 0.005};
  const auto with = [](double behind) {
    return told(PolicyId::no_intervention, PolicyId::aeb, {behind, behind, behind});
  };
  EXPECT_TRUE(convinces(with(0.0), PolicyId::no_intervention, rule));
  EXPECT_FALSE(convinces(with(-0.0005), PolicyId::no_intervention, rule));
  Oracle harmful = with(0.1);
  harmful.verdicts[manoeuvre::index(PolicyId::no_intervention)].expected.harm.value = 0.02;
  EXPECT_FALSE(convinces(harmful, PolicyId::no_intervention, rule));
}

TEST(Showcase, TheReasonQuotesBothAndBraking) {
  Oracle oracle = told(PolicyId::aes_left, PolicyId::t_drift_left, {0.02, 0.01, 0.03});
  oracle.ranking.push_back(PolicyId::aeb);
  const std::string why = why_right(oracle, PolicyId::aes_left);
  EXPECT_THAT(why, HasSubstr("AES-L 0.0010"));
  EXPECT_THAT(why, HasSubstr("T-D-L 0.0210"));
  EXPECT_THAT(why, HasSubstr("AEB"));
}

}  // namespace
}  // namespace saca::eval::showcase_test
