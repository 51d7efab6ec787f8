#include "saca/lab/paper_comparison/table_request.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/methods.h"

namespace saca::paper_comparison::table_request_test {
namespace {

using testing::Contains;
using testing::Not;

const eval::PaperTable& table(const char* name) {
  return *eval::find_paper_table(name);
}

TEST(TableRequest, TablesAreWantedByNumber) {
  EXPECT_EQ(number_of(table("table_2_late")), "2_late");
  EXPECT_TRUE(is_wanted(table("table_3"), {}));
  EXPECT_TRUE(is_wanted(table("table_3"), {.only = {"2", "3"}}));
  EXPECT_FALSE(is_wanted(table("table_2_late"), {.only = {"2", "3"}}));
}

TEST(TableRequest, EveryMethodThatIsComparedIsOne) {
  const suites::ThinkingOptions all{.memory = "bank", .model = "local", .untuned = "base"};
  const std::vector<std::string> methods = compared_methods(all);
  for (const std::string& method : methods) {
    EXPECT_NE(eval::find_method(method), nullptr) << method;
  }
  EXPECT_EQ(methods.front(), "saca");
  EXPECT_THAT(methods, Contains("saca_no_memory"));
  EXPECT_THAT(methods, Contains("saca_paper_untuned"));
  const std::vector<std::string> bare = compared_methods({});
  EXPECT_THAT(bare, Not(Contains("saca_no_memory")));
  EXPECT_THAT(bare, Not(Contains("saca_no_model")));
  EXPECT_THAT(bare, Not(Contains("saca_untuned")));
  EXPECT_THAT(bare, Contains("saca_unaware"));
}

// As many draws of each condition, ten at least, and at least as many encounters as asked for.
TEST(TableRequest, ASuiteHasAsManyDrawsOfEachCondition) {
  EXPECT_EQ(num_few(6), 60);
  EXPECT_EQ(suite_of(table("table_2"), 6, {.count = 1}).count, 60);
  EXPECT_EQ(suite_of(table("table_2"), 6, {.count = 1'000}).count, 1'002);
  const suites::SuiteRequest suite = suite_of(
      table("table_3"), 1,
      {.count = 12, .seed = 7, .threads = 3, .thinking = {.model = "local"}, .output = "out"});
  EXPECT_EQ(suite.name, "table_3");
  EXPECT_EQ(suite.count, 12);
  EXPECT_EQ(suite.seed, 7U);
  EXPECT_EQ(suite.threads, 3);
  EXPECT_EQ(suite.thinking.model, "local");
  EXPECT_EQ(suite.output, "out/table_3.h5");
}

TEST(TableRequest, TheCommandHasAllThatChangesTheFigures) {
  EXPECT_EQ(command_text({.count = 12, .seed = 2}), "saca tables --count 12 --seed 2");
  const std::string told = command_text({.count = 12,
                                         .seed = 2,
                                         .thinking = {.model = "local"},
                                         .methods = "saca,aeb",
                                         .only = {"2", "3"}});
  EXPECT_EQ(told, "saca tables --count 12 --seed 2" + suites::thinking_text({.model = "local"}) +
                      " --methods saca,aeb --table 2,3");
}

}  // namespace
}  // namespace saca::paper_comparison::table_request_test
