#include "saca/lab/shell/line_description.h"

#include <gmock/gmock.h>

#include "saca/base/core/contract.h"
#include "saca/lab/shell/line_for_test.h"

namespace saca::shell::line_description_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Choices, AreTheWordsBetweenBraces) {
  EXPECT_THAT(choices_of("TEXT:{real,lockstep}"), ElementsAre("real", "lockstep"));
  EXPECT_THAT(choices_of("{one}"), ElementsAre("one"));
  EXPECT_THAT(choices_of("TEXT"), IsEmpty());
  EXPECT_THAT(choices_of("}{"), IsEmpty());
  EXPECT_THAT(choices_of(""), IsEmpty());
}

OptionDescription described_by(const std::string& type, const std::string& usual) {
  OptionDescription option{.names = {"--x"}, .about = "What"};
  describe_value(option, type, usual);
  return option;
}

TEST(AValue, HasANameARangeAndADefault) {
  const OptionDescription range = described_by("FLOAT in [0 - 60]", "4.5");
  EXPECT_EQ(range.value, "FLOAT");
  EXPECT_EQ(range.about, "What (in [0 - 60]) (default: 4.5)");
  const OptionDescription words = described_by("TEXT:{real,lockstep}", "");
  EXPECT_EQ(words.value, "TEXT");
  EXPECT_EQ(words.about, "What");
  EXPECT_EQ(described_by("", "").value, "VALUE");
}

TEST(APart, IsACommandWithAllBelowItAndNoneThatOnlyBeginsAlike) {
  LineDescription line = small_line();
  line.push_back({.name = "saca memory-like"});
  const LineDescription part = part_of(line, "saca memory");
  ASSERT_EQ(part.size(), 2U);
  EXPECT_EQ(part[0].name, "saca memory");
  EXPECT_EQ(part[1].name, "saca memory list");
  EXPECT_TRUE(part_of(line, "saca mem").empty());
}

TEST(WhatACommandDoes, IsFoundBehindItsOuterOne) {
  const LineDescription line = small_line();
  EXPECT_EQ(about(line, line[2], "list"), "All cases");
  EXPECT_THROW((void)about(line, line[0], "list"), ContractViolation);
}

}  // namespace
}  // namespace saca::shell::line_description_test
