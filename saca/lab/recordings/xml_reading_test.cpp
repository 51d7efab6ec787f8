#include "saca/lab/recordings/xml_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace saca::recordings::xml_reading_test {
namespace {

using testing::HasSubstr;

class Notes : public testing::Test {
 protected:
  static constexpr std::string_view text =
      "<a>\n <b id='7'><c> 1.5\n</c><c>x</c></b>\n <d><exact>2</exact></d><e/><e/>\n</a>";
  Notes() { document_.load_buffer(text.data(), text.size()); }
  pugi::xml_document document_;
  XmlReading reading_{text, "notes.xml"};
};

TEST_F(Notes, ReadsNumbersWithSpaceAroundThem) {
  const pugi::xml_node b = document_.child("a").child("b");
  EXPECT_EQ(reading_.inner(b, "c", 0.0, 2.0), 1.5);
  EXPECT_EQ(reading_.exact(document_.child("a"), "d", 0.0, 2.0), 2.0);
  EXPECT_EQ(reading_.id(b, "id"), 7);
  EXPECT_FALSE(reading_.problem());
}

TEST_F(Notes, NamesTheFirstProblemsPlace) {
  const pugi::xml_node b = document_.child("a").child("b");
  EXPECT_EQ(reading_.number(b.last_child(), 0.0, 2.0), 0.0);
  EXPECT_EQ(reading_.number(b.first_child(), 2.0, 3.0), 0.0);
  ASSERT_TRUE(reading_.problem());
  EXPECT_EQ(reading_.problem()->message, "notes.xml:3: /a/b[@id=7]/c[2]: want a number, got `x`");
  EXPECT_EQ(reading_.problem()->code, Error::Code::malformed);
}

TEST_F(Notes, RefusesWhatIsOutOfBoundsOrNoId) {
  const pugi::xml_node b = document_.child("a").child("b");
  (void)reading_.inner(b, "c", 2.0, 3.0);
  EXPECT_EQ(reading_.problem()->code, Error::Code::out_of_range);
  EXPECT_THAT(reading_.problem()->message, HasSubstr("want 2 to 3, got `1.5`"));
  XmlReading other(text, "notes.xml");
  EXPECT_EQ(other.id(document_.child("a"), "id"), 0);
  EXPECT_THAT(other.problem()->message, HasSubstr("notes.xml:1: /a: attribute id"));
}

TEST_F(Notes, CountsWhatNobodyReads) {
  reading_.ignore_but(document_.child("a"), {"b"});
  reading_.ignore(document_.child("a").child("b"), " (odd)");
  EXPECT_THAT(reading_.ignored(),
              testing::ElementsAre(testing::Pair("a/b (odd)", 1), testing::Pair("a/d", 1),
                                   testing::Pair("a/e", 2)));
}

// Examples of The Unicode Standard, table 3-7 and its text.
TEST(FirstFaultOfUtf8, FollowsUnicode) {
  EXPECT_FALSE(first_fault_of_utf8("plain"));
  EXPECT_FALSE(first_fault_of_utf8("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x9A\x97"));
  EXPECT_EQ(first_fault_of_utf8("a\xE9"), 1U);             // Latin-1
  EXPECT_EQ(first_fault_of_utf8("\xC0\xAF"), 0U);          // longer than need be
  EXPECT_EQ(first_fault_of_utf8("\xE0\x9F\x80"), 0U);      // likewise
  EXPECT_EQ(first_fault_of_utf8("ab\xED\xA0\x80"), 2U);    // half of a pair
  EXPECT_EQ(first_fault_of_utf8("\xF4\x90\x80\x80"), 0U);  // beyond Unicode
  EXPECT_EQ(first_fault_of_utf8("\xE2\x82"), 0U);          // cut
  EXPECT_EQ(first_fault_of_utf8("x\x80"), 1U);             // begins in the middle
}

TEST(ShownText, CutsAndTrims) {
  EXPECT_EQ(shown_text(" \n 12 "), "`12`");
  EXPECT_EQ(shown_text(std::string(100, 'x')).size(), 42U);
}

}  // namespace
}  // namespace saca::recordings::xml_reading_test
