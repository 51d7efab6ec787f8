#include "saca/lab/regulation/regulation_run.h"

#include <gmock/gmock.h>

#include "saca/lab/eval/regulation_file.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/regulation/run_for_test.h"

namespace saca::regulation::regulation_run_test {
namespace {

using testing::HasSubstr;

eval::Regulation stopped_leads(const char* file) {
  return with_rows(eval::load_regulation(file).value(), {"stopped_lead"}).value();
}

TEST(RegulationRun, CountsWhatIsChosen) {
  const RegulationRun run = some_run();
  const PassCount all = passed_by(run, {.method = 1});
  EXPECT_EQ(all.passed, 5);
  EXPECT_EQ(all.all, 8);
  EXPECT_EQ(all.failed(), 3);
  EXPECT_EQ(all.worst, 12.0);
  EXPECT_EQ(all.faults, 0);
  const PassCount small = passed_by(run, {.method = 1, .car = 0});
  EXPECT_EQ(small.passed, 3);
  EXPECT_EQ(small.worst, 8.0);
  // What hits as hard as is allowed is passed, and no failure's impact.
  const PassCount helped = passed_by(run, {.method = 1, .manual_braking = true});
  EXPECT_EQ(helped.passed, 2);
  EXPECT_EQ(helped.worst, 0.0);
  EXPECT_EQ(passed_by(run, {.method = 1, .car = 1, .row = 0}).failed(), 2);
  EXPECT_EQ(passed_by(run, {.method = 0}).faults, 1);
}

TEST(RegulationRun, FaultsAndMethodsAreFound) {
  RegulationRun run = some_run();
  EXPECT_TRUE(has_faults(run));
  run.results[3 * run.methods.size()].judged.verdict = eval::TestVerdict::passed;
  EXPECT_FALSE(has_faults(run));
  EXPECT_EQ(index_of(run, "aeb"), 1U);
  EXPECT_EQ(index_of(run, "rss"), std::nullopt);
}

TEST(RegulationRun, RowsAreChosenByName) {
  const eval::Regulation all = some_run().regulation;
  EXPECT_EQ(with_rows(all, {}).value().rows.size(), 3U);
  const eval::Regulation two = with_rows(all, {"plate", "standing_car"}).value();
  ASSERT_EQ(two.rows.size(), 2U);
  EXPECT_EQ(two.rows[0].name, "plate");
  EXPECT_EQ(eval::cells_of(two).size(), 3U);
  const auto wrong = with_rows(all, {"plates"});
  ASSERT_FALSE(wrong.has_value());
  EXPECT_EQ(wrong.error().code, Error::Code::out_of_range);
  EXPECT_THAT(wrong.error().message, HasSubstr("no row is called plates; did you mean 'plate'"));
}

// UN R152, 5.2.1.4: who does nothing hits with the speed it has; AEB stops in time at 20 km/h.
TEST(RegulationRun, PlaysEveryCellWithEveryMethod) {
  static SteadyClock clock;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  const runtime::PlanesSetup setup{.forecast = {&car, &harm}, .clock = &clock};
  eval::Regulation text = stopped_leads("data/protocols/r152.toml");
  text.rows[0].speeds = {from_kmh(20.0)};
  text.rows[0].impact_speeds = {0.0};
  const TestedCar tested{&car, &setup, &intent::shipped_model()};
  const auto run = played(
      tests_of(text, {"one", "again"}, {"nothing", "aeb"}), std::vector<TestedCar>{tested, tested},
      {.imitators = {}, .threads = 2, .display = long_work::ProgressDisplay::silent});
  ASSERT_TRUE(run.has_value());
  ASSERT_EQ(run->results.size(), 4U);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(run->at(k, 0, 0).judged.verdict, eval::TestVerdict::contact);
    EXPECT_NEAR(run->at(k, 0, 0).judged.impact_speed, from_kmh(20.0), 0.1);
    EXPECT_FALSE(run->at(k, 0, 0).acted_at.has_value());
    EXPECT_TRUE(run->at(k, 0, 1).judged.passed());
    EXPECT_TRUE(run->at(k, 0, 1).acted_at.has_value());
    EXPECT_EQ(run->at(k, 0, 1).plan->policy, manoeuvre::PolicyId::aeb);
  }
  EXPECT_EQ(run->elsewhere.size(), text.surfaces.size() - 1);
}

TEST(RegulationRun, BrakingIsPlayedOnEachFurtherSurface) {
  static SteadyClock clock;
  const manoeuvre::Car car = prepare::default_car();
  const collision::HarmModel harm = eval::shipped_harm();
  const runtime::PlanesSetup setup{.forecast = {&car, &harm}, .clock = &clock};
  eval::Regulation text = stopped_leads("data/protocols/r152.toml");
  text.rows[0].speeds = {from_kmh(20.0)};
  text.rows[0].impact_speeds = {0.0};
  text.surfaces.resize(1);
  text.surfaces.push_back({.name = "ice", .grip = 0.15, .source = "assumed"});
  const TestedCar tested{&car, &setup, &intent::shipped_model()};
  const PlayOptions silent{
      .imitators = {}, .threads = 1, .display = long_work::ProgressDisplay::silent};
  const auto run = played(tests_of(text, {"one"}, {"aeb"}), std::vector{tested}, silent);
  ASSERT_TRUE(run.has_value());
  ASSERT_EQ(run->elsewhere.size(), 1U);
  EXPECT_TRUE(run->at(0, 0, 0).judged.passed());
  // 5.6 m/s need v^2 / 2 mu g = 10.5 m on ice, and 1.3 s before there are 7.2 m.
  EXPECT_EQ(run->elsewhere[0].regulation.surface, 1U);
  EXPECT_EQ(run->elsewhere[0].at(0, 0, 0).judged.verdict, eval::TestVerdict::contact);
  const auto without = played(tests_of(text, {"one"}, {"nothing"}), std::vector{tested}, silent);
  ASSERT_TRUE(without.has_value());
  EXPECT_TRUE(without->elsewhere.empty());
}

}  // namespace
}  // namespace saca::regulation::regulation_run_test
