#include "saca/lab/report/record_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "saca/lab/report/page.h"

namespace saca::report::record_page_test {
namespace {

using nlohmann::json;

/// What is made from records of one schema.
struct Report {
  std::string schema;
  Result<std::string> (*html)(std::string_view);
  const Page* page;

  [[nodiscard]] std::string record_with_title(const std::string& title) const {
    return json{{"schema", schema}, {"scenario", {{"title", title}}}}.dump();
  }
};

class HtmlReport : public testing::TestWithParam<Report> {};

INSTANTIATE_TEST_SUITE_P(All, HtmlReport,
                         testing::Values(Report{"saca.record/1", html_report, &encounter_page},
                                         Report{"saca.drive/1", drive_report, &drive_page},
                                         Report{"saca.value_page/1", value_report, &value_page}),
                         [](const auto& made) {
                           return made.param.schema == "saca.drive/1"    ? "Drive"
                                  : made.param.schema == "saca.record/1" ? "Encounter"
                                                                         : "Value";
                         });

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

TEST_P(HtmlReport, HoldsTheRecordUnchangedInMeaning) {
  const std::string record = GetParam().record_with_title("braking, \"hard\"\\ 50 °");
  const auto page = GetParam().html(record);
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(json::parse(embedded_record(page.value())), json::parse(record));
}

TEST_P(HtmlReport, LetsNoTextOfTheRecordEndItsElement) {
  const std::string hostile =
      "</script><script>alert(1)</script><!-- <script> \xE2\x80\xA8 \xE2\x80\xA9 \xE2\x80\xA6";
  const auto page = GetParam().html(GetParam().record_with_title(hostile));
  ASSERT_TRUE(page.has_value());
  const std::string inside = embedded_record(page.value());
  EXPECT_EQ(count(inside, "<"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA8"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA9"), 0U);
  EXPECT_EQ(count(inside, "\xE2\x80\xA6"), 1U) << "an ellipsis is harmless and stays";
  EXPECT_EQ(json::parse(inside)["scenario"]["title"], hostile);
}

TEST_P(HtmlReport, ARecordThatHoldsAMarkerIsNotFilledAgain) {
  const auto page = GetParam().html(GetParam().record_with_title("/* script */ \"record.json\""));
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(json::parse(embedded_record(page.value()))["scenario"]["title"],
            "/* script */ \"record.json\"");
}

TEST_P(HtmlReport, LoadsNothing) {
  const auto made = GetParam().html(GetParam().record_with_title("t"));
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

TEST_P(HtmlReport, HoldsStyleAndScriptOnceEachInsideTheirElements) {
  const auto page = GetParam().html(GetParam().record_with_title("t"));
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(count(page.value(), GetParam().page->css), 1U);
  EXPECT_EQ(count(page.value(), GetParam().page->js), 1U);
  EXPECT_EQ(count(GetParam().page->css, "</"), 0U) << "would end the style element";
  EXPECT_EQ(count(GetParam().page->js, "</script"), 0U) << "would end the script element";
  EXPECT_EQ(count(GetParam().page->js, "innerHTML"), 0U)
      << "text of a record must never become markup";
}

TEST_P(HtmlReport, RefusesWhatIsNoRecord) {
  const auto refused = [](std::string_view text) {
    const auto page = GetParam().html(text);
    EXPECT_FALSE(page.has_value()) << text;
    return page.has_value() ? Error{} : page.error();
  };
  const std::string whole = GetParam().record_with_title("t");
  EXPECT_EQ(refused("").code, Error::Code::malformed);
  EXPECT_EQ(refused(std::string_view(whole).substr(0, whole.size() - 1)).code,
            Error::Code::malformed);
  EXPECT_EQ(refused(whole + whole).code, Error::Code::malformed);
  EXPECT_EQ(refused("{\"a\":" + std::string(500'000, '[')).message,
            "record: want JSON of at most 32 levels, got more at byte 36");
  EXPECT_EQ(refused("[]").code, Error::Code::malformed);
  EXPECT_EQ(refused("{}").code, Error::Code::malformed);
  EXPECT_EQ(refused("{\"schema\":\"\xFF\"}").code, Error::Code::malformed) << "not UTF-8";
  const std::string want = "record: schema: want \"" + GetParam().schema + "\", got ";
  EXPECT_EQ(refused(R"({"schema":7})").message, want + "7");
  EXPECT_EQ(refused(R"({"schema":"saca.record/2"})").message, want + R"("saca.record/2")");
  const std::string other = GetParam().schema == "saca.drive/1" ? "saca.record/1" : "saca.drive/1";
  EXPECT_EQ(refused(json{{"schema", other}}.dump()).message, want + "\"" + other + "\"");
}

}  // namespace
}  // namespace saca::report::record_page_test
