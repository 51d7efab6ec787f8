#include "saca/lab/banks/bank_contents.h"

#include <gtest/gtest.h>

#include "saca/lab/banks/banks_for_test.h"

namespace saca::banks::bank_contents_test {
namespace {

using manoeuvre::PolicyId;

memory::Case unchecked_case() {
  memory::Case one = best_is(PolicyId::es_b_left, 10.0, "van");
  one.id = 12;
  one.plan = manoeuvre::default_plan(PolicyId::aeb, 10.0);
  one.harm = 0.5;
  one.best_harm = 0.25;
  one.collision_loss = 2.0;
  one.review = "too late";
  one.trust = memory::Trust::unchecked;
  one.count = 3;
  return one;
}

TEST(CaseList, HasTheFiguresOfEachCase) {
  const nlohmann::json list = list_json(std::vector{unchecked_case()});
  EXPECT_EQ(list, nlohmann::json::parse(R"([{"id": 12, "source": "van", "policy": 0, "best": 3,
      "harm": 0.5, "best_harm": 0.25, "collision_loss": 2.0, "review": "too late",
      "origin": "simulation", "trust": "unchecked", "count": 3}])"));
  EXPECT_EQ(list_json({}), nlohmann::json::array());
}

TEST(CaseList, MarksWhatIsNotTrusted) {
  memory::Case trusted = best_is(PolicyId::aeb, 10.0, "a");
  trusted.id = 1;
  EXPECT_EQ(list_text(std::vector{trusted, unchecked_case()}, "bank"),
            "    1  a                        did 0 best 0  \n"
            "   12  van                      did 0 best 3  too late  [unchecked]\n");
  EXPECT_EQ(list_text({}, "bank"), "bank: no cases yet\n");
}

TEST(BankContents, AreCountedByKind) {
  const EmptyFolder folder;
  {
    memory::Store store = open_to_add(folder.file("bank")).value();
    memory::Case expert = best_is(PolicyId::aeb, 20.0, "b");
    expert.origin = memory::Origin::expert;
    ASSERT_TRUE(
        store.add_all(std::vector{best_is(PolicyId::aeb, 10.0, "a"), expert, unchecked_case()})
            .has_value());
  }
  const ReadBank bank = read_bank(folder.file("bank")).value();
  const BankContents contents = contents_of(bank).value();
  EXPECT_EQ(contents.name, folder.file("bank"));
  EXPECT_EQ(contents.cases, 3U);
  EXPECT_EQ(std::stoull(contents.digest, nullptr, 16), bank.store.digest().value());
  EXPECT_EQ(contents.digest.size(), 16U);
  EXPECT_EQ(contents.origins, (std::map<std::string, int>{{"expert", 1}, {"simulation", 2}}));
  EXPECT_EQ(contents.trust, (std::map<std::string, int>{{"trusted", 2}, {"unchecked", 1}}));
  EXPECT_EQ(contents.best, (std::map<std::string, int>{{"AEB", 2}, {"ES-B-L", 1}}));
}

TEST(BankContents, AreToldToProgramsAndPeople) {
  const BankContents contents{.name = "bank",
                              .cases = 3,
                              .digest = "00000000000000ff",
                              .origins = {{"expert", 1}, {"own", 2}},
                              .trust = {{"trusted", 3}},
                              .best = {{"AEB", 3}}};
  EXPECT_EQ(json_of(contents), nlohmann::json::parse(R"({"schema": "saca.memory_bank/1",
      "file": "bank", "cases": 3, "digest": "00000000000000ff",
      "origins": {"expert": 1, "own": 2}, "trust": {"trusted": 3}, "best": {"AEB": 3}})"));
  EXPECT_EQ(text_of(contents),
            "bank: 3 cases, all whole; digest 00000000000000ff\n"
            "from   1 expert, 2 own\ntrust  3 trusted\nbest   3 AEB\n");
  EXPECT_EQ(text_of({.name = "bank", .digest = "0"}), "bank: 0 cases, all whole; digest 0\n")
      << "there is nothing to count";
}

}  // namespace
}  // namespace saca::banks::bank_contents_test
