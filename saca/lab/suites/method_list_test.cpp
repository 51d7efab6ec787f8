#include "saca/lab/suites/method_list.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/methods.h"

namespace saca::suites::method_list_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MethodList, IsReadInItsOrder) {
  EXPECT_THAT(methods_from("oracle,saca,aeb", {}, "").value(),
              ElementsAre("oracle", "saca", "aeb"));
  EXPECT_EQ(joined({"oracle", "saca"}), "oracle,saca");
  EXPECT_EQ(joined({}), "");
}

TEST(MethodList, FindsAMethod) {
  EXPECT_EQ(index_of({"saca", "aeb"}, "aeb"), 1U);
  EXPECT_EQ(index_of({"saca", "aeb"}, "oracle"), std::nullopt);
}

TEST(MethodList, EmptyIsAllThatThereIsWithWhatWasGiven) {
  const auto num = [](const ThinkingOptions& thinking, const std::string& danger) {
    return methods_from("", thinking, danger).value().size();
  };
  const ThinkingOptions all{.memory = "bank.db", .model = "local", .untuned = "local:other"};
  EXPECT_EQ(num(all, "weights"), eval::methods().size());
  const auto without = methods_from("", {}, "").value();
  EXPECT_LT(without.size(), eval::methods().size());
  for (const std::string& name : without) {
    const eval::Needs needs = eval::find_method(name)->needs;
    EXPECT_TRUE(needs == eval::Needs::nothing || needs == eval::Needs::imitator) << name;
  }
}

TEST(MethodList, RefusesWhatCannotBe) {
  const auto why = [](const std::string& list) {
    return methods_from(list, {}, "").error().message;
  };
  EXPECT_THAT(why("aeb,orakle"),
              AllOf(HasSubstr("no method is called orakle"), HasSubstr("oracle")));
  EXPECT_EQ(why("aeb,saca,aeb"), "--methods: want each method once, got \"aeb\" twice");
  EXPECT_EQ(why("saca_no_memory"),
            "--methods: want --memory FILE with \"saca_no_memory\", which is SACA with all but "
            "that");
  EXPECT_THAT(why("saca_no_model"), HasSubstr("want --llm MODEL"));
  EXPECT_THAT(why("saca_untuned"), HasSubstr("want --untuned MODEL with \"saca_untuned\", which "
                                             "asks that one"));
  EXPECT_THAT(why("least_danger"), HasSubstr("want --danger WEIGHTS with \"least_danger\", which "
                                             "chooses by V_h"));
}

TEST(MethodList, UsualOnesAreThereAndSacaStandsBesideItself) {
  const auto usual = methods_from(usual_methods({}), {}, "");
  ASSERT_TRUE(usual.has_value()) << usual.error().message;
  EXPECT_EQ(usual.value().front(), "saca");
  EXPECT_EQ(usual.value().back(), "oracle");
  const ThinkingOptions thinking{.memory = "bank.db", .model = "local", .untuned = "other"};
  EXPECT_TRUE(usual_methods(thinking).starts_with(
      "saca,saca_no_memory,saca_no_model,saca_untuned,saca_at_t1,"));
  EXPECT_TRUE(methods_from(usual_methods(thinking), thinking, "").has_value());
}

TEST(MethodList, OnlyNetworksThatAreNeededAreRead) {
  EXPECT_TRUE(imitators_of({"aeb", "saca"}, "no_such_folder").value()->empty());
  const auto shipped = imitators_of({"aeb", "imitation_drivers"}, "models");
  ASSERT_TRUE(shipped.has_value()) << shipped.error().message;
  EXPECT_EQ(shipped.value()->size(), 1U);
  EXPECT_TRUE(shipped.value()->contains("imitation_drivers"));
  EXPECT_FALSE(imitators_of({"imitation"}, "no_such_folder").has_value());
}

}  // namespace
}  // namespace saca::suites::method_list_test
