#include "saca/lab/banks/case_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::case_picture_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;

memory::Case numbered(match::CaseId id, double speed) {
  memory::Case one = best_is(PolicyId::aes_left, speed, "van of case");
  one.id = id;
  return one;
}

TEST(CaseView, ShowsTwoSecondsAndHarmsTheLeastFirst) {
  memory::Case one = numbered(7, 10.0);
  one.told = memory::PolicyHarms{0.25, std::nullopt, 0.125};
  one.happened.reset();
  const report::SceneView view = case_view(one, "title", "badge");
  EXPECT_EQ(view.title, "title");
  EXPECT_EQ(view.badge, "badge");
  EXPECT_EQ(view.policy, PolicyId::aes_left);
  EXPECT_THAT(view.lines, testing::ElementsAre("van of case", "expected: AES-R 0.125, AEB 0.250",
                                               "in hindsight: not known"));
  ASSERT_EQ(view.ego.X_WA.size(), 21U);
  EXPECT_DOUBLE_EQ(view.ego.start, one.scene.time);
  EXPECT_NEAR(view.ego.X_WA.back().p.x - view.ego.X_WA.front().p.x, 20.0, 1e-9)
      << "straight on at 10 m/s";
}

TEST(CaseView, SaysNothingOfTrust) {
  memory::Case one = numbered(7, 10.0);
  EXPECT_EQ(title_of(one), "Case 7");
  EXPECT_EQ(trust_badge(one), "");
  one.trust = memory::Trust::quarantined;
  EXPECT_EQ(trust_badge(one), "quarantined");
}

TEST(CasePicture, HasTheCaseAndThoseMostLikeIt) {
  const std::vector<memory::Case> all{numbered(3, 10.0), numbered(5, 10.7)};
  const std::vector<CaseNeighbour> near{{&all[1], 0.9, "differs: speed 1.0"}};
  const std::string picture = case_picture(all[0], near);
  EXPECT_THAT(picture, testing::StartsWith("<svg"));
  EXPECT_THAT(picture, HasSubstr("Case 3"));
  EXPECT_THAT(picture, HasSubstr("Case 5"));
  EXPECT_THAT(picture, HasSubstr("90 %"));
  EXPECT_THAT(picture, HasSubstr("differs: speed 1.0"));
  EXPECT_THAT(picture, HasSubstr("Then the 1 cases most like it"));
  EXPECT_THAT(case_picture(all[0], {}), HasSubstr("Then the 0 cases most like it"));
}

}  // namespace
}  // namespace saca::banks::case_picture_test
