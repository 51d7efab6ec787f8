#include "saca/lab/cases/crash_case.h"

#include <gmock/gmock.h>

#include "saca/lab/cases/cases_for_test.h"
#include "saca/lab/cases/crash_search.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/scenes_for_test.h"

namespace saca::cases::crash_case_test {
namespace {

using testing::HasSubstr;

/// One of a family, as the search finds it, judged by hand.
CrashCase example() {
  static const families::Family family = [] {
    families::Family slower = families::load_family("scenarios/families", "slower_lead").value();
    slower.name = "fars_2016_40001";
    return slower;
  }();
  const manoeuvre::Car car = prepare::default_car();
  const CrashFound found = find_crash(family, std::nullopt, "compact_rwd_ev", car,
                                      eval::shipped_harm(), {.seed = 3, .most = 5});
  CrashCase one = found_case(family.name, family, found);
  one.judged.one.scene = eval::scene_at(found.scenario, car, found.as_written.time);
  one.judged.one.plan = manoeuvre::Plan{.policy = manoeuvre::PolicyId::aeb, .strength = 0.6};
  one.judged.plans = {{one.judged.one.plan, 0.25, 0.5, true}, {{}, 0.5, 1.0, false}};
  one.judged.admissible_harm = 0.252;
  one.judged.speaks_for = one.judged.one.plan;
  one.judged.driver = manoeuvre::PolicyId::es_b_right;
  one.judged.happened[0] =
      eval::PolicyOverDraws{.plan = one.judged.one.plan, .harm = {0.2, 0.1, 0.3}, .contact = 0.75};
  return one;
}

TEST(CrashCase, ComesBackFromItsLineToTheLastBit) {
  const CrashCase one = example();
  const std::string text = crash_cases_text(std::vector{one, one});
  const auto read = crash_cases_from_text(text, "cases.jsonl");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read.value().size(), 2U);
  EXPECT_EQ(to_json(read.value()[1]), to_json(one));
  EXPECT_EQ(crash_cases_text(read.value()), text);
}

// Files of before drivers were told of are read, too.
TEST(CrashCase, WithoutADriverItComesBackAsWell) {
  CrashCase one = example();
  one.judged.driver.reset();
  EXPECT_FALSE(to_json(one).contains("driver"));
  EXPECT_EQ(crash_case_from_json(to_json(one)).value().judged.driver, std::nullopt);
}

TEST(CrashCase, IsDrawnAgainAsItWas) {
  const CrashCase one = example();
  const auto again = drawn_again(one, "compact_rwd_ev", scenario::standard_ego);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again.value().scenario.grip, one.grip);
  EXPECT_EQ(std::get<scenario::EgoStart>(again.value().scenario.ego).speed,
            one.judged.one.scene.ego.v_B.x);
}

TEST(CrashCase, OfARecordingIsNotDrawn) {
  CrashCase one = example();
  one.kind = std::nullopt;
  EXPECT_THAT(drawn_again(one, "compact_rwd_ev", scenario::standard_ego).error().message,
              HasSubstr("got a recording"));
  one.kind = "no_such";
  EXPECT_THAT(drawn_again(one, "compact_rwd_ev", scenario::standard_ego).error().message,
              HasSubstr("unknown kind no_such"));
  one = example();
  std::erase_if(one.ranges, [](const RecordRange& range) { return range.key == "grip"; });
  EXPECT_THAT(drawn_again(one, "compact_rwd_ev", scenario::standard_ego).error().message,
              HasSubstr("want one for grip"));
}

std::string complaint(const std::string& from, const std::string& to) {
  std::string text = crash_cases_text(std::vector{example()});
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto read = crash_cases_from_text(text, "c.jsonl");
  return read.has_value() ? "" : read.error().message;
}

TEST(CrashCase, RefusesWhatIsNoLineOfOne) {
  EXPECT_THAT(complaint("saca.crash_cases/1", "saca.cases/1"),
              HasSubstr("c.jsonl: line 1: schema"));
  EXPECT_THAT(complaint("\"cases\":1", "\"cases\":2"), HasSubstr("want 2 cases, as line 1 says"));
  EXPECT_THAT(complaint("\"family\":", "\"kin\":"), HasSubstr("line 2: family: is missing"));
  EXPECT_THAT(complaint("\"ego_face\":\"front\"", "\"ego_face\":\"top\""),
              HasSubstr("want front, left, right or rear"));
  EXPECT_THAT(complaint("\"name\":\"AEB\"", "\"name\":\"NI\""),
              HasSubstr("name: want the policy's"));
  EXPECT_THAT(complaint("\"best_policy\":0", "\"best_policy\":9"), HasSubstr("best_policy"));
}

}  // namespace
}  // namespace saca::cases::crash_case_test
