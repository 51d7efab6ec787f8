#include "saca/lab/report/intention_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::report::intention_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

IntentionPage page_of(std::size_t samples) {
  IntentionPage page{.title = "Samples", .lines = {"What to look at."}};
  for (std::size_t i = 0; i < samples; ++i) {
    IntentionSample sample;
    sample.title = "vehicle " + std::to_string(i);
    sample.seen.resize(5);
    sample.labels.assign(5, 0);
    sample.scored.assign(5, true);
    page.samples.push_back(sample);
  }
  return page;
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(IntentionPage, HoldsEachSampleAndOneStyle) {
  const std::string html = intention_page(page_of(60));
  EXPECT_EQ(times(html, "<figure>"), 60U);
  EXPECT_EQ(times(html, "<style>"), 1U);
  EXPECT_THAT(html, HasSubstr("vehicle 59"));
  EXPECT_EQ(html, intention_page(page_of(60)));
}

TEST(IntentionPage, NeedsNothingElse) {
  const std::string html = intention_page(page_of(2));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("url(http")));
  EXPECT_THAT(intention_page(page_of(0)), HasSubstr("</html>"));
}

TEST(IntentionPage, TextIsEscaped) {
  IntentionPage page = page_of(1);
  page.title = page.lines[0] = page.samples[0].title = "<script>1</script>";
  EXPECT_THAT(intention_page(page), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace saca::report::intention_page_test
