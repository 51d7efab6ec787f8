#include "saca/lab/cases/chat_set_report.h"

#include <gtest/gtest.h>

namespace saca::cases::chat_set_report_test {
namespace {

TEST(ChatSetReport, TellsOfOneSet) {
  const ChatSetFigures figures{
      .examples = 12, .tokens = 3400, .learnt_tokens = 560, .longest = 300};
  EXPECT_EQ(chat_set_json("a.jsonl", figures), (nlohmann::json{{"file", "a.jsonl"},
                                                               {"examples", 12},
                                                               {"tokens_at_most", 3400},
                                                               {"learnt_tokens_at_most", 560},
                                                               {"longest_tokens_at_most", 300}}));
  EXPECT_EQ(chat_set_text("a.jsonl", figures),
            "a.jsonl: 12 examples, up to 3400 tokens, of them up to 560 to be learnt, up to 300 in "
            "one\n");
}

}  // namespace
}  // namespace saca::cases::chat_set_report_test
