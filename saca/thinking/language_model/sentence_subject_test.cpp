#include "saca/thinking/language_model/sentence_subject.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/thinking/language_model/example_situation.h"

namespace saca::language_model::sentence_subject_test {
namespace {

using manoeuvre::PolicyId;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

// The example has truck1 and pedestrian1.
Subject subject(std::string_view low) {
  return subject_of(low, example_situation());
}

TEST(Subject, IsWhoIsNamed) {
  const Subject both = subject("truck1 and pedestrian1, not car7");
  EXPECT_EQ(both.actors.size(), 2U);
  EXPECT_THAT(both.unknown, ElementsAre("car7"));
  EXPECT_THAT(subject("a truck").actors, IsEmpty());
  EXPECT_THAT(subject("truck12").unknown, ElementsAre("truck12"));
}

TEST(Subject, IsWhichPoliciesAreNamed) {
  EXPECT_THAT(subject("policy 6").policies, ElementsAre(PolicyId::t_drift_right));
  EXPECT_THAT(
      subject("actions 1, 3 and 5").policies,
      UnorderedElementsAre(PolicyId::aes_left, PolicyId::es_b_left, PolicyId::t_drift_left));
  EXPECT_THAT(subject("policies 1 to 4").policies,
              UnorderedElementsAre(PolicyId::aes_left, PolicyId::aes_right, PolicyId::es_b_left,
                                   PolicyId::es_b_right));
  EXPECT_THAT(subject("policy 8 or 12").policies, IsEmpty());
  EXPECT_THAT(subject("so t-d-r").policies, ElementsAre(PolicyId::t_drift_right));
}

TEST(Subject, IsMisnumberedBesideAnotherNumber) {
  EXPECT_EQ(subject("8 t-d-r").misnumbered, PolicyId::t_drift_right);
  EXPECT_EQ(subject("6 t-d-r").misnumbered, std::nullopt);
  EXPECT_EQ(subject("at 1.5 aeb").misnumbered, std::nullopt) << "a decimal is no policy's number";
}

TEST(Subject, IsASideWhereOneAloneIsNamed) {
  EXPECT_EQ(subject("the left is blocked").side, 1);
  EXPECT_EQ(subject("go rightward").side, -1);
  EXPECT_EQ(subject("left or right").side, 0);
  EXPECT_EQ(subject("nothing left-handed").side, 1);
  EXPECT_EQ(subject("straight on").side, 0);
}

TEST(Subject, IsTheMostAlikeCaseWhereItIsSpokenOf) {
  EXPECT_TRUE(subject("a case 83 % alike").of_case);
  EXPECT_TRUE(subject("best in hindsight").of_case);
  EXPECT_FALSE(subject("aeb is clear").of_case);
}

TEST(Subject, HasItsLinesOfThePrompt) {
  const std::string prompt =
      "ego: 14 m/s\ntruck1: 16 m ahead\npedestrian1: 6.0 m ahead\n0 AEB: clear\n"
      "1 AES-L: hits truck1\nA case 83 % alike: best in hindsight 0 AEB, harm 0.072\n";
  const preview::Situation situation = example_situation();
  const auto about = [&](std::string_view low) {
    return lines_about(prompt, subject_of(low, situation), situation);
  };
  EXPECT_EQ(about("nobody"), prompt);
  EXPECT_THAT(about("pedestrian1"), HasSubstr("pedestrian1: 6.0 m"));
  EXPECT_THAT(about("pedestrian1"), Not(HasSubstr("truck1")));
  EXPECT_THAT(about("aeb"), testing::AllOf(HasSubstr("0 AEB"), Not(HasSubstr("1 AES-L"))));
  EXPECT_THAT(about("aeb"), Not(HasSubstr("A case")));
  EXPECT_THAT(about("in the case aeb"), HasSubstr("A case 83 %"));
  EXPECT_THAT(about("in the case aes-l"), Not(HasSubstr("A case")));
  // Of another policy's line whom it hits is no subject.
  EXPECT_THAT(about("truck1"), HasSubstr("1 AES-L"));
  EXPECT_THAT(about("truck1: aeb"), testing::AllOf(HasSubstr("truck1: 16 m"), HasSubstr("0 AEB"),
                                                   Not(HasSubstr("1 AES-L"))));
  EXPECT_THAT(about("aeb"), HasSubstr("ego: 14")) << "what the ego does may be said anywhere";
}

}  // namespace
}  // namespace saca::language_model::sentence_subject_test
