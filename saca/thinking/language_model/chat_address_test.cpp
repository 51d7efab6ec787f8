#include "saca/thinking/language_model/chat_address.h"

#include <gmock/gmock.h>

namespace saca::language_model::chat_address_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string refusal(std::string_view base, bool with_key = false) {
  const auto address = chat_address(base, with_key);
  return address.has_value() ? "taken: " + address.value() : address.error().message;
}

TEST(ChatAddress, StandsBehindTheBase) {
  EXPECT_EQ(chat_address("https://api.openai.com/v1", true).value(),
            "https://api.openai.com/v1/chat/completions");
  EXPECT_EQ(chat_address("http://10.0.0.7:8080/v1/", false).value(),
            "http://10.0.0.7:8080/v1/chat/completions");
  EXPECT_EQ(chat_address("http://host", false).value(), "http://host/chat/completions");
}

TEST(ChatAddress, WithAKeyPlainHttpStaysOnThisMachine) {
  for (const char* base : {"http://127.0.0.1:8080/v1", "http://[::1]/v1", "http://localhost/v1"}) {
    EXPECT_TRUE(chat_address(base, true).has_value()) << base;
  }
  for (const char* base : {"http://10.0.0.7/v1", "http://localhost.example/v1", "http://[::2]/v1",
                           "http://127.0.0.1.example/v1"}) {
    EXPECT_THAT(refusal(base, true), AllOf(HasSubstr("want https"), HasSubstr(base)));
  }
}

TEST(ChatAddress, RefusalSaysWhatWasWanted) {
  EXPECT_THAT(refusal("api.openai.com/v1"), HasSubstr("want http:// or https://"));
  EXPECT_THAT(refusal("file:///etc/passwd"), HasSubstr("want http:// or https://"));
  EXPECT_THAT(refusal(""), HasSubstr("want http:// or https://"));
  EXPECT_THAT(refusal("http://a b/v1"), HasSubstr("spaces"));
  EXPECT_THAT(refusal("http://a/v1\r\nX: y"), HasSubstr("got http://a/v1  X: y"));
  EXPECT_THAT(refusal("http://\xC3\xA9/v1"), HasSubstr("ASCII"));
  EXPECT_THAT(refusal("http://"), HasSubstr("want http(s)://host"));
  EXPECT_THAT(refusal("http://a:port/v1"), HasSubstr("want http(s)://host"));
  EXPECT_THAT(refusal("http://a/v1?key=1"), HasSubstr("neither query"));
}

TEST(ChatAddress, NeverShowsUserAndPassword) {
  EXPECT_THAT(
      refusal("https://me:secret@host/v1"),
      AllOf(HasSubstr("want no user"), HasSubstr("https://***@host/v1"), Not(HasSubstr("secret"))));
  EXPECT_THAT(refusal("me:se/cret@host/v1"), AllOf(HasSubstr("***@host"), Not(HasSubstr("cret"))));
  EXPECT_THAT(refusal("https://me:sec ret@host/v1"), Not(HasSubstr("ret@")));
  EXPECT_EQ(shown_address("https://host/@v1"), "https://host/@v1");
}

}  // namespace
}  // namespace saca::language_model::chat_address_test
