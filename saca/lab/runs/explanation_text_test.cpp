#include "saca/lab/runs/explanation_text.h"

#include <gtest/gtest.h>

namespace saca::runs::explanation_text_test {
namespace {

using nlohmann::json;

const std::vector<report::Paragraph> two{{"In short", {"A car stood there.", "It was seen."}},
                                         {"Nothing", {}}};

TEST(AnExplanation, IsADocumentOfParagraphs) {
  EXPECT_EQ(
      explanation_json(two),
      (json{{"schema", "saca.explanation/1"},
            {"paragraphs", json::array({{{"about", "In short"},
                                         {"sentences", {"A car stood there.", "It was seen."}}},
                                        {{"about", "Nothing"}, {"sentences", json::array()}}})}}));
  EXPECT_EQ(explanation_json({})["paragraphs"], json::array());
}

TEST(AnExplanation, IsATextOfParagraphs) {
  EXPECT_EQ(explanation_text(two), "In short\n  A car stood there.\n  It was seen.\nNothing\n");
  EXPECT_EQ(explanation_text({}), "");
}

}  // namespace
}  // namespace saca::runs::explanation_text_test
