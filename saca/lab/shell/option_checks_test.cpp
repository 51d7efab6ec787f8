#include "saca/lab/shell/option_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace saca::shell::option_checks_test {
namespace {

using testing::HasSubstr;

std::string complaint(const CLI::Validator& check, std::string text) {
  return check(text);
}

TEST(Within, TakesTheEndsAndRefusesWhatIsBeyondOrNoNumber) {
  const CLI::Validator check = within(0.0, 40.0, "m/s");
  EXPECT_EQ(complaint(check, "0"), "");
  EXPECT_EQ(complaint(check, "40"), "");
  EXPECT_EQ(complaint(check, "1e1"), "");
  EXPECT_THAT(complaint(check, "40.1"), HasSubstr("40.1 m/s: want 0 to 40 m/s"));
  EXPECT_THAT(complaint(check, "50"), HasSubstr("km/h"));  // 50 km/h would be within
  for (const char* const none : {"nan", "fast", "", "3x"}) {
    EXPECT_THAT(complaint(check, none), HasSubstr("want 0 to 40 m/s")) << none;
  }
  EXPECT_THAT(complaint(check, "fast"), HasSubstr("got no number"));
  EXPECT_EQ(complaint(within(0.1, 1.2, "-"), "2"), "2: want 0.1 to 1.2");  // without a unit
}

TEST(WholeNumber, TakesWhatFitsAsItWasTyped) {
  const CLI::Validator natural = whole_number<std::uint64_t>();
  const CLI::Validator small = whole_number<int>();
  EXPECT_EQ(natural.get_description(), "");  // help is as without it
  for (const char* const one : {"0", "7", "18446744073709551615"}) {
    EXPECT_EQ(complaint(natural, one), "") << one;
  }
  for (const char* const one : {"-2147483648", "2147483647"}) {
    EXPECT_EQ(complaint(small, one), "") << one;
  }
  EXPECT_EQ(complaint(natural, "-1"), "want a whole number, 0 to 18446744073709551615, got '-1'");
  for (const char* const none : {"18446744073709551616", "99999999999999999999999", "010", "0x10",
                                 "1.5", "1e3", "+1", " 1", "1 ", "many", ""}) {
    EXPECT_THAT(complaint(natural, none), HasSubstr("want a whole number")) << none;
  }
  EXPECT_THAT(complaint(small, "2147483648"), HasSubstr("-2147483648 to 2147483647"));
}

TEST(OneOf, TellsWhichWordWasLikelyMeant) {
  const CLI::Validator check = one_of({"real", "lockstep"});
  EXPECT_EQ(complaint(check, "real"), "");
  EXPECT_THAT(complaint(check, "lockstpe"), HasSubstr("did you mean 'lockstep'"));
  EXPECT_THAT(complaint(check, ""), HasSubstr("'' is unknown"));
}

}  // namespace
}  // namespace saca::shell::option_checks_test
