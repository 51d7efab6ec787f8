#include "saca/lab/encounter/outcome_json.h"

#include <gtest/gtest.h>

#include <vector>

namespace saca::encounter::outcome_json_test {
namespace {

using nlohmann::json;

const std::vector<world::Actor> cast{{.id = 1, .kind = world::ActorKind::truck},
                                     {.id = 4, .kind = world::ActorKind::pedestrian}};

TEST(OutcomeJson, NamesWhoIsTouchedWhereAndHow) {
  const collision::Contact contact{.time = 2.5,
                                   .actor = 1,
                                   .other_face = collision::Face::left,
                                   .p_W = {3.0, -1.0},
                                   .n_W = {0.0, 1.0},
                                   .v_rel_W = {-4.0, 3.0},
                                   .relative_speed = 5.0,
                                   .ego_delta_v = 0.5,
                                   .other_delta_v = 4.5};
  const json out = contact_json(contact, cast);
  EXPECT_EQ(out["with"], "pedestrian4");
  EXPECT_EQ(out["other_face"], "left");
  EXPECT_EQ(out["time_s"], 2.5);
  EXPECT_EQ(out["y_m"], -1.0);
  EXPECT_DOUBLE_EQ(out["normal_deg"], 90.0);
  EXPECT_EQ(out["v_rel_x_mps"], -4.0);
  EXPECT_EQ(out["other_delta_v_mps"], 4.5);
}

TEST(OutcomeJson, AnEdgeHasNoFace) {
  const json out = contact_json({.edge = collision::Side::right}, cast);
  EXPECT_EQ(out["with"], "edge");
  EXPECT_TRUE(out["other_face"].is_null());
}

TEST(OutcomeJson, WhereNothingIsTouchedThereIsTheNearest) {
  collision::Outcome outcome;
  outcome.clearance = 0.75;
  outcome.nearest = {.actor = 0, .time = 1.5};
  const json out = outcome_json(outcome, cast);
  EXPECT_TRUE(out["contact"].is_null());
  EXPECT_EQ(out["clearance_m"], 0.75);
  EXPECT_EQ(out["nearest"], (json{{"to", "truck1"}, {"time_s", 1.5}}));
}

}  // namespace
}  // namespace saca::encounter::outcome_json_test
