#include "saca/lab/report/base64.h"

#include <gtest/gtest.h>

#include <string>

namespace saca::report::base64_test {
namespace {

TEST(Base64, EncodesAsTheStandardsExamples) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAnyByte) {
  EXPECT_EQ(base64(std::string("\xff\xff\xfe\x00", 4)), "///+AA==");
}

}  // namespace
}  // namespace saca::report::base64_test
