#include "saca/lab/curricula/episodes_line.h"

#include <gmock/gmock.h>

#include "saca/lab/curricula/episodes_for_test.h"

namespace saca::curricula::episodes_line_test {
namespace {

using testing::HasSubstr;

eval::Episodes numbered(std::vector<std::uint64_t> numbers) {
  eval::Episodes episodes;
  for (const std::uint64_t number : numbers) {
    episodes.of.push_back(harming({0.125, 0.25, 0.5, 0.0, 0.0, 1.0}));
    episodes.of.back().row.number = number;
    episodes.of.back().row.family = "made";
  }
  return episodes;
}

TEST(EpisodesLine, ComesBack) {
  const std::string line = line_of(numbered({3, 103}));
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto back = episodes_from(line, {3, 103});
  ASSERT_TRUE(back.has_value()) << back.error().message;
  ASSERT_EQ(back.value().of.size(), 2U);
  EXPECT_EQ(back.value().of[1].row.number, 103U);
  EXPECT_EQ(back.value().of[1].row.risk.runs[2].harm, 0.5);
  EXPECT_TRUE(back.value().size.empty());
}

TEST(EpisodesLine, OtherSeedsAndEncountersAreRefused) {
  const std::string line = line_of(numbered({3, 103}));
  const auto refusal = [](const std::string& text, const std::vector<std::uint64_t>& numbers) {
    const auto read = episodes_from(text, numbers);
    EXPECT_FALSE(read.has_value());
    return read.has_value() ? Error{} : read.error();
  };
  EXPECT_EQ(refusal(line, {3, 103, 203}).message, "want the episodes of 3 seeds");
  EXPECT_EQ(refusal(line, {3, 104}).message, "want encounter 104, got 103");
  EXPECT_EQ(refusal("{}", {3}).message, "want the episodes of 1 seeds");
  EXPECT_EQ(refusal("[{}]", {3}).code, Error::Code::malformed);
  EXPECT_EQ(refusal("[", {3}).code, Error::Code::malformed);
}

}  // namespace
}  // namespace saca::curricula::episodes_line_test
