#include "saca/lab/report/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::svg_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

TEST(Svg, TextIsNeverMarkup) {
  EXPECT_EQ(escaped("a < b & c > \"d\" 'e'"), "a &lt; b &amp; c &gt; &quot;d&quot; &#39;e&#39;");
  const std::string hostile = "</text><script>alert(1)</script>\" onload=\"x";
  const auto all = xml_elements(svg_document({100.0, 50.0}, hostile, svg_text("a", {}, hostile)));
  EXPECT_TRUE(says(all, hostile));
  for (const XmlElement& element : all) {
    EXPECT_NE(element.name, "script");
    EXPECT_FALSE(element.attributes.contains("onload"));
  }
}

TEST(Svg, WhatXmlForbidsIsReplaced) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped("m/s\xC2\xB2 \xE2\x80\xA6 \xF0\x9F\x9A\x97"),
            "m/s\xC2\xB2 \xE2\x80\xA6 \xF0\x9F\x9A\x97");
  EXPECT_EQ(escaped(std::string_view("a\0b\x1b", 4)), "a" + mark + "b" + mark);
  EXPECT_EQ(escaped("\xC3"), mark);                                // cut short
  EXPECT_EQ(escaped("\xC0\xAF"), mark + mark);                     // longer than needed
  EXPECT_EQ(escaped("\xED\xA0\x80"), mark + mark + mark);          // half of a surrogate pair
  EXPECT_EQ(escaped("\xEF\xBF\xBF"), mark + mark + mark);          // U+FFFF
  EXPECT_EQ(escaped("\xF4\x90\x80\x80").size(), 4 * mark.size());  // beyond U+10FFFF
}

TEST(Svg, NumbersAreShort) {
  EXPECT_EQ(svg_number(12.0), "12");
  EXPECT_EQ(svg_number(1.5), "1.5");
  EXPECT_EQ(svg_number(-0.001), "0");
  EXPECT_EQ(svg_number(-3.146), "-3.15");
  EXPECT_EQ(svg_number(100.0), "100");
  EXPECT_THROW((void)svg_number(std::numeric_limits<double>::quiet_NaN()), ContractViolation);
}

TEST(Svg, PiecesSayWhereTheyAre) {
  const std::array<Vec2, 2> points{Vec2{1.0, 2.0}, Vec2{3.5, -4.0}};
  const auto all = xml_elements(
      svg_part({5.0, 6.0}, {30.0, 20.0},
               svg_rect("r", {1.0, 2.0}, {3.0, 4.0}, "rx=\"2\"") +
                   svg_line("l", {0.0, 1.0}, {2.0, 3.0}) + svg_circle("c", {7.0, 8.0}, 9.0) +
                   svg_polyline("p", points) + svg_text("t", {1.0, 1.0}, "here", Anchor::end)));
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[0].attributes.at("width"), "30");
  EXPECT_EQ(all[1].attributes.at("rx"), "2");
  EXPECT_EQ(all[1].attributes.at("height"), "4");
  EXPECT_EQ(all[2].attributes.at("y2"), "3");
  EXPECT_EQ(all[3].attributes.at("r"), "9");
  EXPECT_EQ(all[4].attributes.at("points"), "1,2 3.5,-4");
  EXPECT_EQ(all[5].attributes.at("text-anchor"), "end");
  EXPECT_EQ(all[5].depth, 1);
}

TEST(Svg, LongTextIsCutWithAnEllipsis) {
  EXPECT_EQ(fitted("short", 11.0, 100.0), "short");
  const std::string cut = fitted("a very long text indeed, longer than its place", 11.0, 100.0);
  EXPECT_TRUE(cut.ends_with("\xE2\x80\xA6"));
  EXPECT_TRUE(cut.starts_with("a very"));
  EXPECT_LE(text_width(cut, 11.0), 100.0);
  // Characters of several bytes are cut between, not within.
  std::string umlauts;
  for (int i = 0; i < 40; ++i) {
    umlauts += "\xC3\xA4";
  }
  const std::string some = fitted(umlauts, 11.0, 100.0);
  EXPECT_EQ(some.size() % 2, 1U) << "pairs of bytes, and three of the ellipsis";
  EXPECT_EQ(escaped(some), some);
  EXPECT_EQ(fitted("x", 11.0, 0.0), "\xE2\x80\xA6");
}

TEST(Svg, TicksAreRound) {
  EXPECT_THAT(round_ticks(0.0, 10.0, 6), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(round_ticks(7.75, 18.25, 8), ElementsAre(8.0, 10.0, 12.0, 14.0, 16.0, 18.0));
  EXPECT_THAT(round_ticks(-0.25, 0.3, 4),
              Pointwise(DoubleNear(1e-12), {-0.2, 0.0, 0.2}));  // 0.1 would make six
  for (const double high : {0.0013, 0.9, 3.3, 47.0, 5e6}) {
    const auto ticks = round_ticks(0.0, high, 7);
    EXPECT_GE(ticks.size(), 3U) << high;
    EXPECT_LE(ticks.size(), 7U) << high;
  }
  EXPECT_THROW((void)round_ticks(1.0, 1.0, 5), ContractViolation);
}

}  // namespace
}  // namespace saca::report::svg_test
