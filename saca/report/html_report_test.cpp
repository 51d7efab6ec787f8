#include "saca/report/html_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "saca/report/page.h"

namespace saca::report {
namespace {

using nlohmann::json;

std::string record_with_title(const std::string& title) {
  return json{{"schema", "saca.record/1"}, {"scenario", {{"title", title}}}}.dump();
}

std::size_t count(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos;
       at = text.find(what, at + 1)) {
    ++n;
  }
  return n;
}

/// What a browser hands to JSON.parse: the text between the record's tags.
std::string embedded_record(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="record">)";
  const std::size_t begin = page.find(open);
  EXPECT_NE(begin, std::string::npos);
  const std::size_t end = page.find("</script", begin);
  EXPECT_NE(end, std::string::npos);
  return page.substr(begin + open.size(), end - begin - open.size());
}

TEST(HtmlReport, HoldsTheRecordUnchangedInMeaning) {
  const std::string record = record_with_title("braking, \"hard\"\\ 50 °");
  const auto page = html_report(record);
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(json::parse(embedded_record(page.value())), json::parse(record));
}

TEST(HtmlReport, LetsNoTextOfTheRecordEndItsElement) {
  const std::string hostile =
      "</script><script>alert(1)</script><!-- <script> \xE2\x80\xA8 \xE2\x80\xA9 \xE2\x80\xA6";
  const auto page = html_report(record_with_title(hostile));
  ASSERT_TRUE(page.has_value());
  const std::string inside = embedded_record(page.value());
  EXPECT_EQ(count(inside, "<"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA8"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA9"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA6"), 1U) << "an ellipsis is harmless and stays";
  EXPECT_EQ(json::parse(inside)["scenario"]["title"], hostile);
}

TEST(HtmlReport, ARecordThatHoldsAMarkerIsNotFilledAgain) {
  const auto page = html_report(record_with_title("/* report.js */ \"record.json\""));
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(json::parse(embedded_record(page.value()))["scenario"]["title"],
            "/* report.js */ \"record.json\"");
}

TEST(HtmlReport, LoadsNothing) {
  const auto made = html_report(record_with_title("t"));
  ASSERT_TRUE(made.has_value());
  const std::string& page = made.value();
  for (const char* loads : {" src=", " href=", "@import", "url(", "fetch(", "XMLHttpRequest",
                            "import(", "WebSocket", "sendBeacon", "<link", "<iframe"}) {
    EXPECT_EQ(count(page, loads), 0U) << loads;
  }
  // The only address in the page names the SVG vocabulary; it is not fetched.
  EXPECT_EQ(count(page, "http://") + count(page, "https://"),
            count(page, "http://www.w3.org/2000/svg"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos) << "the browser enforces it, too";
}

TEST(HtmlReport, HoldsStyleAndScriptOnceEachInsideTheirElements) {
  const auto page = html_report(record_with_title("t"));
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(count(page.value(), page_css), 1U);
  EXPECT_EQ(count(page.value(), page_js), 1U);
  EXPECT_EQ(count(page_css, "</"), 0U) << "would end the style element";
  EXPECT_EQ(count(page_js, "</script"), 0U) << "would end the script element";
  EXPECT_EQ(count(page_js, "innerHTML"), 0U) << "text of a record must never become markup";
}

TEST(HtmlReport, RefusesWhatIsNoRecord) {
  const auto refused = [](std::string_view text) {
    const auto page = html_report(text);
    EXPECT_FALSE(page.has_value()) << text;
    return page.has_value() ? Error{} : page.error();
  };
  const std::string whole = record_with_title("t");
  EXPECT_EQ(refused("").code, Error::Code::malformed);
  EXPECT_EQ(refused(std::string_view(whole).substr(0, whole.size() - 1)).code,
            Error::Code::malformed);
  EXPECT_EQ(refused(whole + whole).code, Error::Code::malformed);
  EXPECT_EQ(refused("[]").code, Error::Code::malformed);
  EXPECT_EQ(refused("{}").code, Error::Code::malformed);
  EXPECT_EQ(refused("{\"schema\":\"\xFF\"}").code, Error::Code::malformed) << "not UTF-8";
  EXPECT_EQ(refused(R"({"schema":7})").message, R"(record: schema: want "saca.record/1", got 7)");
  EXPECT_EQ(refused(R"({"schema":"saca.record/2"})").message,
            R"(record: schema: want "saca.record/1", got "saca.record/2")");
}

}  // namespace
}  // namespace saca::report
