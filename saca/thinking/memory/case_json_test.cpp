#include "saca/thinking/memory/case_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "saca/onboard/match/example_scenes.h"
#include "saca/thinking/memory/scene_json.h"

namespace saca::memory::case_json_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

Case full_case(std::uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Case one;
  one.id = seed + 1;
  one.scene = match::random_scene(rng, 3);
  one.plan = {manoeuvre::PolicyId::es_b_left, 7.0 * share(rng)};
  one.best = manoeuvre::PolicyId::t_drift_right;
  one.harm = share(rng);
  one.best_harm = share(rng);
  one.collision_loss = share(rng);
  one.review = "\"quoted\", a tab\t and an umlaut \xc3\xa4";
  one.source = "a/b";
  one.origin = Origin::recording;
  one.trust = Trust::quarantined;
  one.count = 3;
  one.worst_harm = share(rng);
  one.intentions.resize(3);
  for (auto& posterior : one.intentions) {
    posterior[seed % 8] = share(rng);
  }
  one.risks = {share(rng), 0.0, 1.0};
  one.told = PolicyHarms{share(rng), std::nullopt, 0.0, 1e-300};
  one.happened = PolicyHarms{};
  one.draws = 16;
  one.lessons = {"first", "second"};
  one.made_with = {{"car", "compact", ""}, {"atlas", "a", "0123456789abcdef"}};
  return one;
}

TEST(CaseJson, GivesBackAllOfACaseToTheLastBit) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Case one = full_case(seed);
    const Case back = case_from_json(json::parse(to_json(one).dump())).value();
    EXPECT_EQ(to_json(back), to_json(one));
    EXPECT_EQ(back.id, one.id);
    EXPECT_EQ(back.plan, one.plan);
    EXPECT_EQ(back.origin, one.origin);
    EXPECT_EQ(back.trust, one.trust);
    EXPECT_EQ(back.count, one.count);
    EXPECT_EQ(back.worst_harm, one.worst_harm);
    EXPECT_EQ(back.intentions, one.intentions);
    EXPECT_EQ(back.risks, one.risks);
    EXPECT_EQ(back.told, one.told);
    EXPECT_EQ(back.happened, one.happened);
    EXPECT_EQ(back.draws, one.draws);
    EXPECT_EQ(back.lessons, one.lessons);
    EXPECT_EQ(back.made_with, one.made_with);
  }
}

TEST(CaseJson, LeavesOutWhatVersion2DidNotKnowOfACase) {
  Case one;
  std::mt19937 rng(1);
  one.scene = match::random_scene(rng, 1);
  EXPECT_EQ(details_json(one), json::object());
  EXPECT_EQ(to_json(case_from_json(json::parse(to_json(one).dump())).value()), to_json(one));
}

TEST(CaseJson, NamesTheKeyThatIsWrong) {
  const auto message = [](auto spoil) {
    json document = to_json(full_case(4));
    spoil(document);
    const auto read = case_from_json(json::parse(document.dump()));
    EXPECT_FALSE(read.has_value());
    return read.has_value() ? "" : read.error().message;
  };
  EXPECT_THAT(message([](json& j) { j["schema"] = "saca.case/9"; }), StartsWith("schema: want"));
  EXPECT_THAT(message([](json& j) { j.erase("harm"); }), StartsWith("harm: is missing"));
  EXPECT_THAT(message([](json& j) { j["harm"] = -1; }), StartsWith("harm: want a finite number"));
  EXPECT_THAT(message([](json& j) { j["policy"] = 8; }), StartsWith("policy: want"));
  EXPECT_THAT(message([](json& j) { j["id"] = -3; }), StartsWith("id: want"));
  EXPECT_THAT(message([](json& j) { j["strength"] = 0.5; }), StartsWith("strength: only"));
  EXPECT_THAT(message([](json& j) { j["scene"]["grip"] = 5; }), StartsWith("scene: "));
  EXPECT_THAT(message([](json& j) { j["more"] = 1; }), StartsWith("more: is not known"));
  EXPECT_THAT(message([](json& j) { j["details"]["told"] = "no"; }), HasSubstr("told: want"));
  EXPECT_THAT(message([](json& j) { j["details"]["told"][2] = "no"; }), HasSubstr("told: want"));
  EXPECT_THAT(message([](json& j) {
                j["details"]["risks"] = {1, "x", 0};
              }),
              HasSubstr("risks: want numbers"));
  EXPECT_THAT(message([](json& j) { j["details"]["lessons"] = {7}; }),
              HasSubstr("lessons: want texts"));
  EXPECT_THAT(message([](json& j) { j["details"]["intentions"][0] = {1}; }),
              HasSubstr("intentions"));
  EXPECT_THAT(message([](json& j) { j["details"]["made_with"][0].erase("name"); }),
              HasSubstr("made_with[0].name: is missing"));
  EXPECT_THAT(message([](json& j) { j = 3; }), HasSubstr("want"));
}

TEST(JsonLinesOfCases, ComeBack) {
  const std::vector<Case> cases{full_case(1), full_case(2), full_case(3)};
  const std::string text = cases_text(cases);
  const auto back = cases_from_text(text, "file").value();
  EXPECT_EQ(cases_text(back), text);
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(cases_from_text(cases_text({}), "file").value().size(), 0U);
}

TEST(JsonLinesOfCases, TellTheLineThatIsWrong) {
  const auto message = [](const std::string& text) {
    const auto read = cases_from_text(text, "bank.jsonl");
    EXPECT_FALSE(read.has_value());
    return read.has_value() ? "" : read.error().message;
  };
  const std::vector<Case> cases{full_case(1), full_case(2)};
  const std::string whole = cases_text(cases);
  EXPECT_THAT(message(""), StartsWith("bank.jsonl: line 1: want cases, got nothing"));
  EXPECT_THAT(message("{}\n"), StartsWith("bank.jsonl: line 1: schema: is missing"));
  EXPECT_THAT(message(whole.substr(0, whole.size() - 10)), StartsWith("bank.jsonl: line 3: want"));
  const std::size_t second = whole.rfind('\n', whole.size() - 2) + 1;
  EXPECT_THAT(message(whole.substr(0, second)),
              StartsWith("bank.jsonl: line 3: want 2 cases, as line 1 says, got 1"));
  EXPECT_THAT(message(whole + "\n"), StartsWith("bank.jsonl: line 4: want JSON"));
  const std::vector<Case> twice{full_case(1), full_case(1)};
  EXPECT_THAT(message(cases_text(twice)),
              StartsWith("bank.jsonl: line 3: id: want each once, got 2 a second time"));
}

}  // namespace
}  // namespace saca::memory::case_json_test
