#include "saca/lab/banks/case_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::case_page_test {
namespace {

using manoeuvre::PolicyId;
using testing::HasSubstr;
using testing::Not;

memory::Case told_case(match::CaseId id) {
  memory::Case one = best_is(PolicyId::aes_left, 10.0, "van");
  one.id = id;
  one.plan = manoeuvre::default_plan(PolicyId::aeb, 10.0);
  one.harm = 0.5;
  one.best_harm = 0.125;
  one.count = 2;
  one.draws = 3;
  one.worst_harm = 0.75;
  one.review = "too late";
  one.lessons = {"steer sooner"};
  one.happened = memory::PolicyHarms{0.5, 0.125, std::nullopt};
  one.made_with = {{"car", "compact", "00ff"}, {"harm", "usual", ""}};
  return one;
}

TEST(CasePage, TellsWhatIsKnownOfTheCase) {
  const std::string page = case_page(told_case(4), {}, "saca memory show 4");
  EXPECT_THAT(page, HasSubstr("Case 4"));
  EXPECT_THAT(page, HasSubstr("van. Carried out: AEB; best in hindsight: AES-L. Harm 0.500, of the "
                              "best 0.125."));
  EXPECT_THAT(page, HasSubstr("From: simulation. Trust: trusted. It stands for 2 encounters, the "
                              "worst of which harmed 0.750."));
  EXPECT_THAT(page, HasSubstr("Review: too late"));
  EXPECT_THAT(page, HasSubstr("Lesson, checked: steer sooner"));
  EXPECT_THAT(page, HasSubstr("mean over 3 draws"));
  EXPECT_THAT(page, HasSubstr("cannot be driven"));
  EXPECT_THAT(page, HasSubstr("the case speaks for it"));
  EXPECT_THAT(page, HasSubstr("Made with car compact (00ff), harm usual"));
  EXPECT_THAT(page, HasSubstr("saca memory show 4"));
}

TEST(CasePage, SaysWhatIsNotKnown) {
  memory::Case one = told_case(4);
  one.source.clear();
  one.happened.reset();
  one.made_with.clear();
  one.review.clear();
  one.lessons.clear();
  one.count = 1;
  one.worst_harm.reset();
  const std::string page = case_page(one, {}, "");
  EXPECT_THAT(page, HasSubstr("Its source is not known. Carried out"));
  EXPECT_THAT(page, HasSubstr("It stands for 1 encounter."));
  std::size_t unknown = 0;
  for (std::size_t at = page.find("not known"); at != std::string::npos;
       at = page.find("not known", at + 1)) {
    ++unknown;
  }
  EXPECT_GE(unknown, 1U + manoeuvre::num_policies) << "the source, and what each policy did";
  EXPECT_THAT(page, Not(HasSubstr("Made with")));
  EXPECT_THAT(page, Not(HasSubstr("Review: ")));
}

TEST(CasePage, ShowsThoseMostLikeIt) {
  memory::Case other = told_case(9);
  other.trust = memory::Trust::unchecked;
  const std::vector<CaseNeighbour> near{{&other, 0.81, "differs: grip 2.0"}};
  const std::string page = case_page(told_case(4), near, "");
  EXPECT_THAT(page, HasSubstr("Case 9: 81 % alike"));
  EXPECT_THAT(page, HasSubstr("differs: grip 2.0"));
  EXPECT_THAT(page, HasSubstr("saca memory show 9"));
  EXPECT_THAT(page, HasSubstr("unchecked"));
}

}  // namespace
}  // namespace saca::banks::case_page_test
