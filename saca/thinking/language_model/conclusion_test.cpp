#include "saca/thinking/language_model/conclusion.h"

#include <gtest/gtest.h>

namespace saca::language_model::conclusion_test {
namespace {

using manoeuvre::PolicyId;

TEST(Conclusion, IsWhomTheLastLineThatNamesSomebodyNamesFirst) {
  EXPECT_EQ(concluded("1. NI hits car1.\n2. So AES-L: AEB harms more.\nResponse to user:"),
            PolicyId::aes_left);
  EXPECT_EQ(concluded("1. AEB is clear.\n2. Therefore."), PolicyId::aeb);
  EXPECT_EQ(concluded("1. Nothing\n\n"), std::nullopt);
  EXPECT_EQ(concluded(""), std::nullopt);
}

TEST(Conclusion, NamesAreWholeWords) {
  EXPECT_EQ(first_named("es-b-l, then AEB"), PolicyId::es_b_left);
  EXPECT_EQ(first_named("NICE and UNI, not NI-2: T-D-R"), PolicyId::t_drift_right);
  EXPECT_EQ(first_named("(AEB)"), PolicyId::aeb);
  EXPECT_EQ(first_named("car1"), std::nullopt);
}

}  // namespace
}  // namespace saca::language_model::conclusion_test
