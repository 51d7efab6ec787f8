#include "saca/thinking/memory/scene_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/onboard/match/example_scenes.h"

namespace saca::memory::scene_json_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using world::Scene;

/// Pointer to a value in a scene's JSON, e.g. "/actors/1/kind".
json::json_pointer at(const char* where) {
  return json::json_pointer(where);
}

std::string refusal(const json& document) {
  const auto scene = scene_from_json(document);
  return scene.has_value() ? "" : scene.error().message;
}

// All numbers of a scene, in the order of the structs.
std::vector<double> numbers(const Scene& s) {
  std::vector<double> all{s.time, s.grip, s.grip_sd, s.ego_mass, s.ego.yaw_rate};
  const auto add_vector = [&](Vec2 v) { all.insert(all.end(), {v.x, v.y}); };
  const auto add_pose = [&](const Pose& X) { all.insert(all.end(), {X.p.x, X.p.y, X.yaw}); };
  const auto add_footprint = [&](const world::Footprint& f) {
    all.insert(all.end(), {f.length, f.width, f.centre_x, static_cast<double>(f.shape)});
  };
  add_pose(s.ego.X_WB);
  add_vector(s.ego.v_B);
  add_vector(s.ego.a_B);
  add_footprint(s.ego_footprint);
  add_pose(s.road.X_WL);
  all.insert(all.end(),
             {s.road.curvature, s.road.lane_width, s.road.left_edge, s.road.right_edge,
              static_cast<double>(s.road.topology), static_cast<double>(s.road.left_beyond),
              static_cast<double>(s.road.right_beyond), s.road.oncoming_left ? 1.0 : 0.0,
              s.road.oncoming_right ? 1.0 : 0.0});
  for (const world::Actor& a : s.actors) {
    add_footprint(a.footprint);
    add_pose(a.X_WA);
    add_vector(a.v_W);
    add_vector(a.a_W);
    all.insert(all.end(),
               {a.mass, a.yaw_rate, a.position_sd, a.velocity_sd, a.existence, a.age,
                a.occluded ? 1.0 : 0.0, static_cast<double>(a.kind), static_cast<double>(a.id)});
    for (const auto& control : {a.shared.steering, a.shared.throttle, a.shared.brake}) {
      all.push_back(control.value_or(-10.0));
    }
  }
  return all;
}

TEST(SceneJson, ComesBackToTheLastBitAlsoThroughText) {
  std::mt19937 rng(1);
  for (int i = 0; i < 100; ++i) {
    Scene scene = match::random_scene(rng, i % 33);
    scene.ego.a_B.y = std::bit_cast<double>(std::uint64_t{1} + rng());  // denormal
    for (std::size_t k = 0; k < scene.actors.size(); k += 3) {
      scene.actors[k].shared = {.steering = -0.1 * i / 33.0, .brake = 1.0 / 3.0};
    }
    const auto back = scene_from_json(json::parse(to_json(scene).dump()));
    ASSERT_TRUE(back.has_value()) << back.error().message;
    EXPECT_EQ(numbers(back.value()), numbers(scene));
  }
}

TEST(SceneJson, AWallComesBackAndACarCannotBeOne) {
  Scene scene = match::crossing_truck();
  scene.actors[1].kind = world::ActorKind::obstacle;
  scene.actors[1].footprint = {world::Shape::segment, 12.0, 0.0, 0.5};
  const json document = to_json(scene);
  const auto back = scene_from_json(document);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(numbers(back.value()), numbers(scene));
  json car = document;
  car[at("/actors/1/kind")] = "car";
  EXPECT_THAT(refusal(car), HasSubstr("only an obstacle is a segment"));
}

TEST(SceneJson, CuesComeBackAndScenesWithoutAreAsBefore) {
  Scene scene = match::crossing_truck();
  EXPECT_FALSE(to_json(scene).contains("cues"));
  scene.cues.push_back({world::CueKind::parked_vans, {12.5, -1.0 / 3.0}});
  scene.cues.push_back({world::CueKind::low_sun, {0.0, 4.0}});
  json document = json::parse(to_json(scene).dump());
  const auto back = scene_from_json(document);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  ASSERT_EQ(back.value().cues.size(), 2U);
  EXPECT_EQ(back.value().cues[0].kind, world::CueKind::parked_vans);
  EXPECT_EQ(back.value().cues[0].p_W.y, -1.0 / 3.0);
  EXPECT_EQ(back.value().cues[1].kind, world::CueKind::low_sun);
  json other = document;
  other[at("/cues/1/kind")] = "tram";
  EXPECT_THAT(refusal(other), HasSubstr("cues[1].kind: want school_zone"));
  other = document;
  other[at("/cues/0/x_m")] = 1e8;
  EXPECT_THAT(refusal(other), HasSubstr("cues lie within 10,000 km"));
  other = document;
  other["cues"] = json::array(
      {other["cues"][0], other["cues"][0], other["cues"][0], other["cues"][0], other["cues"][0]});
  EXPECT_THAT(refusal(other), HasSubstr("cues: want"));
}

TEST(SceneJson, CarriesUnitsInItsKeysAndNamesForKinds) {
  const json document = to_json(match::crossing_truck());
  EXPECT_EQ(document["schema"], "saca.scene/1");
  EXPECT_EQ(document["ego"]["forward_mps"], 14.0);
  EXPECT_EQ(document["actors"][1]["kind"], "pedestrian");
  EXPECT_EQ(document["actors"][1]["vy_mps"], 1.2);
  EXPECT_EQ(document["road"]["left_edge_m"], 5.25);
}

TEST(SceneJson, RefusesEveryMissingAndEveryUnknownKey) {
  const json good = to_json(match::crossing_truck());
  const json flat = good.flatten();
  int num_keys = 0;
  for (const auto& [where, value] : flat.items()) {
    const json::json_pointer pointer(where);
    json without = good;
    without[pointer.parent_pointer()].erase(pointer.back());
    EXPECT_THAT(refusal(without), HasSubstr(pointer.back() + ": is missing"));
    json with = good;
    with[pointer.parent_pointer()]["extra_key"] = 1;
    EXPECT_THAT(refusal(with), HasSubstr("extra_key: is not known"));
    ++num_keys;
  }
  EXPECT_GT(num_keys, 80);
}

TEST(SceneJson, RefusesEveryValueOfTheWrongType) {
  const json good = to_json(match::crossing_truck());
  const json flat = good.flatten();
  for (const auto& [where, value] : flat.items()) {
    for (const json& wrong : {json(nullptr), json::array(), json::object(), json("no such word")}) {
      json document = good;
      document[json::json_pointer(where)] = wrong;
      EXPECT_THAT(refusal(document), HasSubstr(json::json_pointer(where).back() + ": want"));
    }
  }
  for (const json& wrong : {json(nullptr), json(3), json("scene"), json::array({1, 2})}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("scene: want an object"));
  }
}

TEST(SceneJson, NamesThePlaceWhatWasWantedAndWhatCame) {
  json document = to_json(match::crossing_truck());
  document[at("/actors/2/kind")] = "tank";
  EXPECT_EQ(refusal(document),
            "actors[2].kind: want car, van, truck, motorcycle, bicycle, pedestrian or obstacle, "
            "got \"tank\"");
  document = to_json(match::crossing_truck());
  document[at("/ego/footprint/length_m")] = std::string(1000, 'x');
  EXPECT_THAT(refusal(document), HasSubstr("ego.footprint.length_m: want a finite number, got"));
  EXPECT_LT(refusal(document).size(), 200U);
}

TEST(SceneJson, RefusesAnUnknownVersion) {
  json document = to_json(match::crossing_truck());
  document["schema"] = "saca.scene/2";
  EXPECT_EQ(refusal(document), "schema: want saca.scene/1, got \"saca.scene/2\"");
}

TEST(SceneJson, RefusesWhatIsNotFiniteOrOutOfRange) {
  json document = to_json(match::crossing_truck());
  document["grip"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(document), HasSubstr("grip: want a finite number"));
  document["grip"] = 1.5;
  EXPECT_THAT(refusal(document), HasSubstr("grip is in (0, 1.2]"));
  for (const json& id : {json(256), json(-1), json(1.5)}) {
    document = to_json(match::crossing_truck());
    document[at("/actors/0/id")] = id;
    EXPECT_THAT(refusal(document), HasSubstr("actors[0].id: want an integer"));
  }
}

TEST(SceneJson, RefusesMoreActorsThanASceneHolds) {
  json document = to_json(match::crossing_truck());
  for (int i = 0; i < 30; ++i) {
    document["actors"].push_back(document["actors"][0]);
  }
  EXPECT_EQ(refusal(document), "actors: want at most 32, got 33");
}

TEST(SceneJson, IsNotWrittenForASceneThatIsNone) {
  Scene broken = match::crossing_truck();
  broken.ego.v_B.x = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)to_json(broken), ContractViolation);
}

}  // namespace
}  // namespace saca::memory::scene_json_test
