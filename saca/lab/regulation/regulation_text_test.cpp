#include "saca/lab/regulation/regulation_text.h"

#include <gmock/gmock.h>

#include "saca/lab/regulation/run_for_test.h"

namespace saca::regulation::regulation_text_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Columns of 22 and 20 characters behind a blank.
std::string line(const std::string& name, const std::string& a, const std::string& b) {
  const auto right = [](const std::string& word) {
    return std::string(21 - word.size(), ' ') + word;
  };
  return "\n" + name + std::string(22 - name.size(), ' ') + right(a) + right(b) + "\n";
}

TEST(RegulationText, HasALineForEachRowAndCar) {
  const std::string text = text_of(some_run());
  EXPECT_THAT(text, StartsWith("Some text: 4 tests with each of 2 cars; tests passed\n"));
  EXPECT_THAT(text, HasSubstr(line("row", "nothing", "aeb")));
  EXPECT_THAT(text, HasSubstr(line("standing_car", "4 of 4", "1 of 4")));
  EXPECT_THAT(text, HasSubstr(line("plate", "1 of 2", "2 of 2")));
  EXPECT_THAT(text, HasSubstr(line("small", "3 of 4", "3 of 4")));
  EXPECT_THAT(text, HasSubstr(line("all", "7 of 8", "5 of 8")));
  EXPECT_THAT(text, HasSubstr("\n\nFull braking at the paper's T1 = 1.3 s would not be allowed"));
  EXPECT_EQ(text.back(), '\n');
}

TEST(RegulationText, WithoutBrakingItEndsWithTheCounts) {
  const std::string text = text_of(tests_of(some_run().regulation, {"small"}, {"nothing"}));
  EXPECT_THAT(text, testing::EndsWith("4 of 4\n\n"));
}

}  // namespace
}  // namespace saca::regulation::regulation_text_test
