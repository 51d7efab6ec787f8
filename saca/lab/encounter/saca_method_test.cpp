#include "saca/lab/encounter/saca_method.h"

#include <gmock/gmock.h>

#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/wreck_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::encounter::saca_method_test {
namespace {

/// Plays a method to the end, alone.
struct Played {
  std::optional<double> acted_at;
  Action action;
  collision::Outcome outcome;
  ThinkingFigures thinking;
};

class SacaMethodTest : public testing::Test {
 protected:
  Played play(const scenario::Scenario& scenario) {
    const Stage stage{&scenario, &car_, &harm_, &intent::shipped_model(), {}, {}};
    SacaMethod saca({.forecast = {&car_, &harm_}, .clock = &clock_}, intent::shipped_model());
    ClosedLoop loop(stage);
    Played played;
    while (!loop.over()) {
      EXPECT_FALSE(loop.look().has_value());
      loop.wake();
      if (const auto action = saca.step({loop.seen(), loop.beliefs(), loop.confirmed(),
                                         loop.driven(), loop.finished(), loop})) {
        played.acted_at = loop.time();
        played.action = *action;
      }
      loop.keep();
      loop.advance(*saca.avoider());
    }
    played.thinking = saca.thinking().value();
    played.outcome = loop.outcome().value_or(collision::Outcome{});
    return played;
  }

  SteadyClock clock_;
  manoeuvre::Car car_ = prepare::default_car();
  collision::HarmModel harm_ = prepare::read_harm("data/harm.toml").value();
};

TEST_F(SacaMethodTest, DoesWhatAnEncounterWithTheSameSetupDoes) {
  const scenario::Scenario scenario = wreck_on_wet_road();
  const Played played = play(scenario);
  Silence silence;
  const Record record = run({.scenario = &scenario,
                             .car = &car_,
                             .harm = &harm_,
                             .intent = &intent::shipped_model(),
                             .clock = &clock_},
                            silence)
                            .value();
  ASSERT_TRUE(played.acted_at.has_value());
  ASSERT_TRUE(record.decision.has_value());
  EXPECT_EQ(*played.acted_at, record.decision->time);
  EXPECT_EQ(played.action.plan, record.decision->plan);
  EXPECT_EQ(played.action.source, "arbiter");
  EXPECT_EQ(played.action.reason, "no plan is cached");
  EXPECT_EQ(played.outcome.harm, record.result.harm);
  EXPECT_EQ(played.outcome.clearance, record.result.clearance);
  EXPECT_EQ(played.thinking, thinking_figures(record.previews, record.decision));
  EXPECT_GT(played.thinking.forecasts, 0);
}

}  // namespace
}  // namespace saca::encounter::saca_method_test
