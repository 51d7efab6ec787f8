#include "saca/lab/suites/thinking_options.h"

#include <gtest/gtest.h>

namespace saca::suites::thinking_options_test {
namespace {

TEST(ThinkingOptions, AreArgumentsOfACommand) {
  EXPECT_EQ(thinking_text({}), "");
  EXPECT_EQ(thinking_text({.memory = "bank.db", .model = "local", .untuned = "m@http://h"}),
            " --memory bank.db --llm local --untuned m@http://h");
  EXPECT_EQ(thinking_text({.memory = "", .model = "replay:r", .untuned = ""}), " --llm replay:r");
}

}  // namespace
}  // namespace saca::suites::thinking_options_test
