#include "saca/lab/eval/suite.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "saca/base/core/lending_pool.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/eval/trigger_case.h"
#include "saca/thinking/intent/shipped_model.h"
#include "saca/thinking/language_model/scripted_model.h"
#include "saca/thinking/language_model/shared_model.h"

namespace saca::eval::suite_test {
namespace {

using manoeuvre::PolicyId;

class SuiteTest : public testing::Test {
 protected:
  SuiteRow run(std::vector<std::string> methods, std::uint64_t number = 4) {
    SuiteEncounter encounter{
        .number = number, .family = "made", .scenario = standing_car(19.0, 60.0), .twin = {}};
    encounter.twin = encounter.scenario;
    encounter.twin->actors.clear();
    return run_encounter(encounter, {.methods = std::move(methods), .seed = 2},
                         {.forecast = {&car_, &harm_}, .clock = &clock_}, intent::shipped_model());
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = shipped_harm();
};

TEST_F(SuiteTest, SameSeedSameLine) {
  const SuiteRow row = run({"aeb", "random"});
  EXPECT_EQ(line_of(row), line_of(run({"aeb", "random"})));
  EXPECT_NE(line_of(row), line_of(run({"aeb", "random"}, 5)));  // other draws
  ASSERT_TRUE(row.twin.has_value());
  EXPECT_FALSE(row.twin->runs[0].intervened());
}

TEST_F(SuiteTest, ALineComesBack) {
  const SuiteRow row = run({"aeb", "nothing"});
  const auto back = suite_row_from(line_of(row), 2);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(line_of(back.value()), line_of(row));
  EXPECT_EQ(back.value().risk.runs[1].harm, row.risk.runs[1].harm);
  ASSERT_EQ(back.value().risk.tried.size(), row.risk.tried.size());
  for (std::size_t i = 0; i < row.risk.tried.size(); ++i) {
    EXPECT_EQ(back.value().risk.tried[i].plan, row.risk.tried[i].plan) << i;
  }
  EXPECT_EQ(back.value().risk.published_best_harm, row.risk.published_best_harm);
  EXPECT_GE(row.risk.published_best_harm, row.risk.best_harm - 1e-4);  // a class of harm
  EXPECT_THAT(suite_row_from(line_of(row), 3).error().message,
              testing::HasSubstr("want runs of 3 methods, got 2"));
  for (const char* const spoilt :
       {"", "{", "[]", R"({"number": -1})", R"({"number": 1, "family": 7})"}) {
    EXPECT_FALSE(suite_row_from(spoilt, 2).has_value()) << spoilt;
  }
  EXPECT_THAT(suite_row_from(std::string(500'000, '['), 2).error().message,
              testing::HasSubstr("want JSON of at most 32 levels"));
}

/// SACA with a memory that holds the scene at T1, where the best is to the left, or with a model
/// that says so.
class ThinkingTest : public SuiteTest {
 protected:
  ThinkingTest() {
    const scenario::Scenario scenario = only_left_helps();
    std::filesystem::remove(path_);
    memory::Store memory = memory::Store::open(path_).value();
    EXPECT_TRUE(memory
                    .add({.scene = scene_at(scenario, car_, trigger_time(scenario, car_).value()),
                          .best = PolicyId::aes_left})
                    .has_value());
  }
  ~ThinkingTest() override { std::filesystem::remove(path_); }

  SuiteRow run(const std::vector<std::string>& methods, memory::Store* memory,
               language_model::LanguageModel* model, std::uint64_t number = 4) {
    return run_encounter(
        {.number = number, .family = "made", .scenario = only_left_helps(), .twin = {}},
        {.methods = methods, .exact = true},
        {.forecast = {&car_, &harm_}, .model = model, .memory = memory, .clock = &clock_},
        intent::shipped_model());
  }
  [[nodiscard]] memory::Store snapshot() const { return memory::Store::snapshot(path_).value(); }

  std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) / "saca_suite_test.db";
  language_model::ScriptedModel model_{
      language_model::ScriptedReply{.lines = {{.text = "because",
                                               .answer = language_model::Answer::Kind::ended,
                                               .policy = PolicyId::aes_left,
                                               .probability = 0.9}}},
      clock_};
};

TEST_F(ThinkingTest, ARowIsSacaWithWhatItWasGiven) {
  memory::Store memory = snapshot();
  const SuiteRow row = run({"saca", "saca_no_memory", "saca_no_model", "aeb"}, &memory, &model_);
  const auto& runs = row.risk.runs;
  EXPECT_EQ(runs[0].source, "memory");
  EXPECT_EQ(runs[1].source, "model");
  EXPECT_EQ(runs[2].source, "memory");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(runs[i].plan->policy, PolicyId::aes_left) << i;
    EXPECT_LT(runs[i].harm, runs[3].harm) << i;
  }
  EXPECT_GT(runs[0].thinking->from_memory, 0);
  EXPECT_EQ(runs[0].thinking->asked, 0);
  EXPECT_EQ(runs[1].thinking->recalled, 0);
  EXPECT_NEAR(runs[1].thinking->answer.value()[1], 0.9, 1e-12);
  EXPECT_EQ(runs[3].thinking, std::nullopt);
  EXPECT_EQ(snapshot().size(), 1U);  // nothing was learnt

  const SuiteRow back = suite_row_from(line_of(row), 4).value();
  EXPECT_EQ(line_of(back), line_of(row));
  EXPECT_EQ(back.risk.runs[1].thinking, runs[1].thinking);
}

// In 200 cases like this one, going left was told to harm nobody and did.
TEST_F(ThinkingTest, ExperienceCorrectsWhatIsExpectedOfOneDecision) {
  const scenario::Scenario scenario = only_left_helps();
  memory::Case one = case_at_trigger({&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}},
                                     {&car_, &harm_}, 16, {})
                         .value()
                         .value();
  for (const PolicyId left : {PolicyId::aes_left, PolicyId::es_b_left, PolicyId::t_drift_left}) {
    one.told->at(manoeuvre::index(left)) = 0.0;
    one.happened->at(manoeuvre::index(left)) = 5.0;
  }
  const std::vector<memory::Case> cases(200, one);
  const memory::Experience experience(cases);
  const SuiteRow row =
      run_encounter({.number = 0, .family = "f", .scenario = scenario, .twin = {}},
                    {.methods = {"beliefs_drawn", "beliefs_and_experience"},
                     .experience = &experience,
                     .exact = true},
                    {.forecast = {&car_, &harm_}, .clock = &clock_}, intent::shipped_model());
  EXPECT_EQ(manoeuvre::side(row.risk.runs[0].plan->policy), 1);
  EXPECT_NE(manoeuvre::side(row.risk.runs[1].plan->policy), 1);
}

TEST_F(ThinkingTest, WithoutEitherTheVerdictDecides) {
  const SuiteRow row = run({"saca", "saca_no_memory"}, nullptr, nullptr);
  EXPECT_EQ(row.risk.runs[0].source, "arbiter");
  EXPECT_EQ(row.risk.runs[0].reason, "no plan is cached");
}

TEST_F(ThinkingTest, AModelThatIsSilentIsToldAsTheReason) {
  language_model::ScriptedModel nonsense(
      language_model::ScriptedReply{.error = Error{Error::Code::malformed, "no answer in it"}},
      clock_);
  const MethodRun saca = run({"saca"}, nullptr, &nonsense).risk.runs[0];
  EXPECT_EQ(saca.reason, "the model gave no answer in time");
  EXPECT_GT(saca.thinking->asked, 0);
  EXPECT_EQ(saca.thinking->answered, 0);
}

TEST_F(ThinkingTest, ThreadsDoNotChangeRows) {
  std::vector<memory::Store> stores;
  stores.push_back(snapshot());
  stores.push_back(snapshot());
  LendingPool memories(std::move(stores));
  const auto rows = [&](int threads) {
    language_model::SharedModel model(model_, clock_);
    std::vector<std::string> lines(2);
    in_parallel(lines.size(), threads, [&](std::size_t i) {
      const auto memory = memories.lend();
      lines[i] = line_of(run({"saca", "saca_no_memory"}, memory.get(), &model, i));
    });
    return lines;
  };
  EXPECT_EQ(rows(1), rows(2));
}

TEST(DriverRowTest, AgreesWhereBothBrakeOrNotAndGoToTheSameSide) {
  using manoeuvre::Plan;
  const DriverRow brakes{.brakes = true};
  EXPECT_TRUE(agrees(brakes, Plan{PolicyId::aeb, std::nullopt}));
  EXPECT_FALSE(agrees(brakes, Plan{PolicyId::es_b_left, 5.0}));
  EXPECT_FALSE(agrees(brakes, std::nullopt));
  const DriverRow both{.brakes = true, .steers = -1};
  EXPECT_TRUE(agrees(both, Plan{PolicyId::es_b_right, 5.0}));
  EXPECT_FALSE(agrees(both, Plan{PolicyId::aes_right, std::nullopt}));
  EXPECT_TRUE(agrees(DriverRow{}, std::nullopt));
}

TEST(Suite, PlaysWithNoiseUnlessItIsExact) {
  const scenario::Scenario scenario = standing_car(19.0, 60.0);
  EXPECT_EQ(as_played(scenario, {.methods = {"aeb"}, .exact = true}).perception,
            scenario::PerceptionModel{});
  EXPECT_EQ(as_played(scenario, {.methods = {"aeb"}}).perception, usual_perception());
  scenario::Scenario own = scenario;
  own.perception.latency = 0.3;
  EXPECT_EQ(as_played(own, {.methods = {"aeb"}}).perception, own.perception);
  EXPECT_NE(encounter_seed(1, 2), encounter_seed(2, 1));
}

}  // namespace
}  // namespace saca::eval::suite_test
