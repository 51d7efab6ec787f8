#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "saca/lab/encounter/encounter.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/thinking/intent/shipped_model.h"

namespace saca::encounter::record_json_test {
namespace {

using nlohmann::json;

/// A real run towards somebody who stands on the road, too slow to drift, and its record as JSON.
struct Run {
  Record record;
  json out;
};

Run made_run() {
  scenario::Scenario scenario{
      .name = "wreck", .title = "A wreck", .car = "x", .grip = 0.9, .duration = 4.0};
  scenario.ego = scenario::EgoStart{.pose = {}, .speed = 9.0};
  scenario.actors.push_back(
      {.id = 1,
       .kind = world::ActorKind::pedestrian,
       .footprint = {.shape = world::Shape::ellipse, .length = 0.5, .width = 0.5},
       .mass = 75.0,
       .motion = scenario::Script{.start = {.s = 40.0}, .behaviour = scenario::Behaviour::hold}});
  const auto car = prepare::default_car();
  const auto harm = prepare::read_harm("data/harm.toml").value();
  const intent::Model& intent = intent::shipped_model();
  SteadyClock clock;
  Silence quiet;
  const encounter::Setup setup{
      .scenario = &scenario, .car = &car, .harm = &harm, .intent = &intent, .clock = &clock};
  Record record = run(setup, quiet).value();
  json out = json::parse(record_json(setup, record));
  return {std::move(record), std::move(out)};
}

const Run& the_run() {
  static const Run one = made_run();
  return one;
}

// What follows is what docs/formats.md promises.
TEST(RecordJson, HoldsTheSceneAndWhatWasPreviewed) {
  const auto& [record, out] = the_run();
  EXPECT_EQ(out["schema"], "saca.record/1");
  EXPECT_EQ(out["model"], "off");
  EXPECT_EQ(out["actors"][0]["id"], "pedestrian1");
  EXPECT_EQ(out["actors"][0]["shape"], "ellipse");
  EXPECT_EQ(out["frames"].size(), record.frames.size());
  EXPECT_EQ(out["frames"][0]["ego"]["speed_mps"], 9.0);
  EXPECT_TRUE(out["scenario"]["driver"].is_null());
  EXPECT_EQ(out["previews"][0]["facts"].size(), 8U);
  EXPECT_EQ(out["previews"][0]["actors"][0]["posterior"].size(), 3U);  // of a walker
  EXPECT_EQ(out["thresholds"]["material_harm"], 0.01);
  EXPECT_GE(out["timing"]["preview_s"], 0.0);
  EXPECT_TRUE(out["timing"]["first_answer_s"].is_null());  // nobody was asked
  for (const json& event : out["events"]) {
    EXPECT_TRUE(event.contains("t_s") && event.contains("plane") && event.contains("kind") &&
                event.contains("text"));
  }
}

// One row every 0.1 s from the start on; the times are those of looks.
TEST(RecordJson, HoldsWhatWasBelievedOfIntentions) {
  const auto& [record, out] = the_run();
  ASSERT_EQ(out["intentions"].size(), 1U);
  const json& seen = out["intentions"][0];
  EXPECT_EQ(seen["actor"], "pedestrian1");
  EXPECT_EQ(seen["of"], (json{"M", "stop", "cross"}));
  EXPECT_EQ(seen["times_s"].size(), record.intentions[0].times.size());
  EXPECT_EQ(seen["times_s"][0], 0.0);
  EXPECT_NEAR(seen["times_s"][7].get<double>(), 0.7, 1e-9);
  ASSERT_EQ(seen["now_permille"].size(), seen["times_s"].size());
  ASSERT_EQ(seen["soon_permille"].size(), seen["times_s"].size());
  EXPECT_EQ(seen["now_permille"][0], "920 0 80");  // it stands on the road: 8 % start to cross
}

// Every verdict with every plan, and what those were made by by which something was begun.
TEST(RecordJson, HoldsVerdictsAndWhatTheyWereMadeBy) {
  const auto& [record, out] = the_run();
  EXPECT_EQ(out["decision"]["source"], "arbiter");
  ASSERT_EQ(out["verdicts"]["in_hand"].size(), record.verdicts.verdicts().size());
  EXPECT_EQ(out["verdicts"]["left_out"], 0);
  const json& in_hand = out["verdicts"]["in_hand"];
  const json& decision = out["decision"];
  const auto decisive = std::find_if(in_hand.begin(), in_hand.end(), [&](const json& one) {
    return one["t_s"] == decision["verdict"]["t_s"];
  });
  ASSERT_NE(decisive, in_hand.end());
  EXPECT_EQ((*decisive)["plans"], decision["verdict"]["plans"]);
  EXPECT_TRUE((*decisive)["under_way"].is_null());
  ASSERT_NE(std::next(decisive), in_hand.end());
  EXPECT_EQ((*std::next(decisive))["under_way"]["name"], decision["name"]);
  ASSERT_EQ(out["hypotheses"].size(), 1U + out["switches"].size());
  EXPECT_EQ(out["hypotheses"][0]["t_s"], decision["time_s"]);
  EXPECT_EQ(out["hypotheses"][0]["scene_s"], decision["verdict"]["t_s"]);
  EXPECT_EQ(out["hypotheses"][0]["motions"][0]["paths"][0]["id"], "pedestrian1");
  double probability = 0.0;
  for (const json& motion : out["hypotheses"][0]["motions"]) {
    probability += motion["probability"].get<double>();
  }
  EXPECT_NEAR(probability, 1.0, 1e-12);
}

TEST(RecordJson, HoldsWhatEachPolicyWouldHaveEndedIn) {
  const json& out = the_run().out;
  EXPECT_EQ(out["hindsight"].size(), 8U);
  EXPECT_FALSE(out["hindsight"][5]["refusal"].is_null());
  EXPECT_GT(out["hindsight"][0]["path"].size(), 10U);
  // Without intervention the front meets the pedestrian, straight ahead to the east at 9 m/s.
  const json& contact = out["hindsight"][7]["contact"];
  EXPECT_EQ(contact["ego_face"], "front");
  EXPECT_NEAR(contact["normal_deg"].get<double>(), 0.0, 0.1);
  EXPECT_NEAR(contact["v_rel_x_mps"].get<double>(), -9.0, 0.1);
  EXPECT_NEAR(contact["v_rel_y_mps"].get<double>(), 0.0, 0.1);
  EXPECT_EQ(out["result"]["false_trigger_loss"], 0.0);  // doing nothing would have hit
}

}  // namespace
}  // namespace saca::encounter::record_json_test
