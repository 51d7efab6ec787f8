#include "saca/base/formats/json_lines.h"

#include <gmock/gmock.h>

#include <vector>

namespace saca::formats::json_lines_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::optional<Error> read(const std::string& text, std::vector<int>& numbers) {
  return read_json_lines(text, "a.jsonl", "test/1", "numbers",
                         [&](const nlohmann::json& one) -> std::optional<std::string> {
                           if (!one.is_number_integer()) {
                             return "want a whole number";
                           }
                           numbers.push_back(one.get<int>());
                           return std::nullopt;
                         });
}

std::string complaint(const std::string& text) {
  std::vector<int> numbers;
  const auto problem = read(text, numbers);
  return problem ? problem->message : "";
}

TEST(JsonLines, GiveBackWhatWasWritten) {
  std::vector<int> numbers;
  EXPECT_FALSE(read(first_json_line("test/1", "numbers", 2) + "3\n-4\n", numbers).has_value());
  EXPECT_THAT(numbers, ElementsAre(3, -4));
}

TEST(JsonLines, RefuseWhatTheFirstLineDoesNotSay) {
  const std::string first = first_json_line("test/1", "numbers", 2);
  EXPECT_THAT(complaint(first + "3\n"), HasSubstr("line 3: want 2 numbers, as line 1 says, got 1"));
  EXPECT_THAT(complaint(first + "3\n4\n5\n"), HasSubstr("got 3"));
  EXPECT_THAT(complaint(""), HasSubstr("a.jsonl: line 1: want numbers, got nothing"));
  EXPECT_THAT(complaint(first_json_line("test/2", "numbers", 0)), HasSubstr("line 1: schema"));
}

TEST(JsonLines, NameTheLineThatIsWrong) {
  const std::string first = first_json_line("test/1", "numbers", 2);
  EXPECT_THAT(complaint(first + "3\n{\n"), HasSubstr("line 3: "));
  EXPECT_EQ(complaint(first + "3\n\"x\"\n"), "a.jsonl: line 3: want a whole number");
}

}  // namespace
}  // namespace saca::formats::json_lines_test
