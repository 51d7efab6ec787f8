#include "saca/lab/report/scene_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::scene_svg_test {
namespace {

using world::Actor;
using world::ActorKind;

world::Track straight_track(Pose X_WB, double speed, double duration) {
  world::Track track{.start = 2.0, .step = 0.01, .X_WA = {}};
  const int steps = static_cast<int>(std::lround(duration / track.step));
  for (int k = 0; k <= steps; ++k) {
    const Vec2 way = rotated({speed * k * track.step, 0.0}, X_WB.yaw);
    track.X_WA.push_back({X_WB.p + way, X_WB.yaw});
  }
  return track;
}

/// The ego at 10 m/s for one second, towards a car at rest 20 m ahead and a pedestrian at its left.
SceneView example() {
  SceneView view;
  view.title = "0 AEB";
  view.lines = {"hits car1"};
  view.scene.time = 2.0;
  view.scene.ego_footprint = {world::Shape::box, 4.7, 1.9, -0.1};
  view.scene.road = {.left_edge = 5.25, .right_edge = -1.75};
  Actor car{.id = 1,
            .kind = ActorKind::car,
            .footprint = {world::Shape::box, 4.0, 1.8, 0.0},
            .X_WA = {{20.0, 0.0}, 0.0}};
  Actor pedestrian{.id = 2,
                   .kind = ActorKind::pedestrian,
                   .footprint = {world::Shape::ellipse, 0.5, 0.6, 0.0},
                   .X_WA = {{10.0, 3.0}, -std::numbers::pi / 2.0}};
  view.scene.actors.push_back(car);
  view.scene.actors.push_back(pedestrian);
  view.others = {straight_track(car.X_WA, 0.0, 1.0), straight_track(pedestrian.X_WA, 1.5, 1.0)};
  view.ego = straight_track({}, 10.0, 1.0);
  collision::Contact contact;
  contact.time = 3.0;
  contact.actor = 0;
  contact.p_W = {18.0, 0.2};
  contact.n_W = {1.0, 0.0};
  view.contacts = {contact};
  return view;
}

std::vector<XmlElement> drawn(const SceneView& view, SvgSize size = usual_thumbnail) {
  return xml_elements(scene_svg(view, size));
}

/// Pixel of the picture's corner in the card, from the nested part that holds it.
Vec2 corner_of_picture(const std::vector<XmlElement>& all) {
  const auto part =
      std::find_if(all.begin() + 1, all.end(), [](const XmlElement& e) { return e.name == "svg"; });
  return {xml_number(*part, "x"), xml_number(*part, "y")};
}

TEST(SceneSvg, BodiesLieToScaleWhereTheyAre) {
  const SceneView view = example();
  const auto all = drawn(view);
  const auto car = with_class(all, "polygon", "car body");
  ASSERT_EQ(car.size(), 1U);
  const auto corners = xml_points(car[0]);
  ASSERT_EQ(corners.size(), 4U);
  const double length = norm(corners[0] - corners[1]);
  const double width = norm(corners[1] - corners[2]);
  EXPECT_NEAR(length / width, 4.0 / 1.8, 0.01);
  // A body 20 m ahead of where the ego began: the middle of its outline.
  const Vec2 middle = corner_of_picture(all) + 0.5 * (corners[0] + corners[2]);
  const Vec2 wanted = scene_pixel(view, usual_thumbnail, {20.0, 0.0});
  EXPECT_NEAR(middle.x, wanted.x, 0.02);
  EXPECT_NEAR(middle.y, wanted.y, 0.02);
  // One metre is as long everywhere and in both directions; left is up.
  const Vec2 origin = scene_pixel(view, usual_thumbnail, {0.0, 0.0});
  const Vec2 left = scene_pixel(view, usual_thumbnail, {0.0, 1.0});
  EXPECT_NEAR(wanted.x - origin.x, 20.0 * (origin.y - left.y), 1e-9);
  EXPECT_NEAR(origin.y - left.y, length / 4.0, 0.01);
}

TEST(SceneSvg, GhostsComeEveryQuarterSecondAndGrowDarker) {
  const auto ghosts = with_class(drawn(example()), "polygon", "ego ghost");
  ASSERT_EQ(ghosts.size(), 4U);  // at 0, 0.25, 0.5, 0.75 s; at 1 s stands the body
  for (std::size_t i = 1; i < ghosts.size(); ++i) {
    EXPECT_GT(xml_number(ghosts[i], "fill-opacity"), xml_number(ghosts[i - 1], "fill-opacity"));
    const Vec2 way = xml_points(ghosts[i])[0] - xml_points(ghosts[i - 1])[0];
    const Vec2 first = xml_points(ghosts[1])[0] - xml_points(ghosts[0])[0];
    EXPECT_NEAR(way.x, first.x, 0.02);
    EXPECT_NEAR(way.y, 0.0, 0.02);
  }
  EXPECT_EQ(with_class(drawn(example()), "polygon", "car ghost").size(), 1U) << "it stands still";
  EXPECT_EQ(with_class(drawn(example()), "ellipse", "pedestrian body").size(), 1U);
}

TEST(SceneSvg, ContactsAreMarked) {
  SceneView view = example();
  collision::Contact second = view.contacts[0];
  second.time = 2.9;
  second.actor.reset();
  second.p_W = {12.0, -1.75};
  view.contacts.push_back(second);
  const auto all = drawn(view);
  const auto stars = with_class(all, "polygon", "star");
  ASSERT_EQ(stars.size(), 1U);
  Vec2 middle;
  const auto points = xml_points(stars[0]);
  for (const Vec2 p : points) {
    middle = middle + (1.0 / static_cast<double>(points.size())) * p;
  }
  const Vec2 wanted = scene_pixel(view, usual_thumbnail, {18.0, 0.2}) - corner_of_picture(all);
  EXPECT_NEAR(middle.x, wanted.x, 0.02);
  EXPECT_NEAR(middle.y, wanted.y, 0.02);
  EXPECT_EQ(with_class(all, "circle", "later").size(), 1U);
  EXPECT_TRUE(says(all, "2"));
  EXPECT_EQ(with_class(all, "polygon", "ego touch").size(), 2U);
  EXPECT_EQ(with_class(all, "polygon", "car touch").size(), 1U);
}

TEST(SceneSvg, TurningTheWorldChangesNothingButRoundings) {
  const SceneView view = example();
  SceneView turned = view;
  const Pose X_VW{{-300.0, 120.0}, 2.1};
  turned.scene.road.X_WL = X_VW * turned.scene.road.X_WL;
  turned.scene.ego.X_WB = X_VW * turned.scene.ego.X_WB;
  for (Actor& actor : turned.scene.actors) {
    actor.X_WA = X_VW * actor.X_WA;
  }
  for (Pose& X : turned.ego.X_WA) {
    X = X_VW * X;
  }
  for (world::Track& track : turned.others) {
    for (Pose& X : track.X_WA) {
      X = X_VW * X;
    }
  }
  turned.contacts[0].p_W = X_VW * turned.contacts[0].p_W;
  const auto all = drawn(view);
  const auto other = drawn(turned);
  ASSERT_EQ(all.size(), other.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].name, other[i].name);
    if (all[i].attributes.contains("points")) {
      const auto a = xml_points(all[i]);
      const auto b = xml_points(other[i]);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_NEAR(norm(a[k] - b[k]), 0.0, 0.02);  // two roundings to 0.01 px
      }
    }
  }
}

TEST(SceneSvg, AMirroredSceneIsTheMirroredPicture) {
  SceneView view = example();
  view.scene.road.right_edge = -5.25;  // or else the picture's middle would move
  SceneView mirrored = view;
  const auto mirror = [](Pose& X) { X = {{X.p.x, -X.p.y}, -X.yaw}; };
  for (world::Track& track : mirrored.others) {
    std::for_each(track.X_WA.begin(), track.X_WA.end(), mirror);
  }
  mirrored.contacts[0].p_W.y = -mirrored.contacts[0].p_W.y;
  const auto all = drawn(view);
  const auto other = drawn(mirrored);
  const auto part =
      std::find_if(all.begin() + 1, all.end(), [](const XmlElement& e) { return e.name == "svg"; });
  const double height = xml_number(*part, "height");
  for (const char* looks : {"pedestrian body", "pedestrian ghost"}) {
    const auto a = with_class(all, "ellipse", looks);
    const auto b = with_class(other, "ellipse", looks);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(xml_number(a[i], "cx"), xml_number(b[i], "cx"), 0.02);
      EXPECT_NEAR(xml_number(a[i], "cy"), height - xml_number(b[i], "cy"), 0.02);
    }
  }
}

TEST(SceneSvg, LanesPointToTheRightAlsoInABend) {
  SceneView view = example();
  view.scene.road.curvature = 0.02;
  view.scene.ego.X_WB = world::from_lane(view.scene.road, {30.0, 0.0, 0.0});
  view.ego = straight_track(view.scene.ego.X_WB, 10.0, 1.0);
  view.scene.actors.clear();
  view.others.clear();
  view.contacts.clear();
  const auto ghosts = with_class(drawn(view), "polygon", "ego ghost");
  const Vec2 way = xml_points(ghosts.back())[0] - xml_points(ghosts.front())[0];
  EXPECT_GT(way.x, 10.0);
  EXPECT_NEAR(way.y, 0.0, 0.02);
}

TEST(SceneSvg, WhoIsFarAwayDoesNotShrinkThePicture) {
  const SceneView view = example();
  SceneView more = view;
  more.scene.actors.push_back({.id = 9,
                               .kind = ActorKind::truck,
                               .footprint = {world::Shape::box, 10.0, 2.5, 0.0},
                               .X_WA = {{400.0, 0.0}, 0.0}});
  more.others.push_back(straight_track({{400.0, 0.0}, 0.0}, 20.0, 1.0));
  EXPECT_EQ(scene_extent(view).high.x, scene_extent(more).high.x);
  EXPECT_FALSE(says(drawn(more), "truck9"));
  EXPECT_TRUE(says(drawn(more), "car1"));
}

TEST(SceneSvg, ALongWayWithoutContactIsCut) {
  SceneView view = example();
  view.contacts.clear();
  view.ego = straight_track({}, 25.0, 10.0);
  EXPECT_LE(scene_extent(view).high.x, longest_view + 15.0);
  view.contacts.push_back({});
  view.contacts[0].time = 8.0;
  view.contacts[0].p_W = {152.0, 0.0};
  EXPECT_GE(scene_extent(view).high.x, 152.0) << "a contact is always shown";
}

TEST(SceneSvg, ARefusedManoeuvreShowsTheSceneAlone) {
  SceneView view = example();
  view.ego.X_WA.clear();
  view.contacts.clear();
  const auto all = drawn(view);
  EXPECT_EQ(with_class(all, "g", "faded").size(), 1U);
  EXPECT_EQ(with_class(all, "polygon", "ego body").size(), 1U);
  EXPECT_TRUE(with_class(all, "polygon", "ego ghost").empty());
}

TEST(SceneSvg, TextsAreEscapedAndFitted) {
  SceneView view = example();
  view.title = "<AEB> & \"friends\"";
  view.badge = "best";
  view.policy = manoeuvre::PolicyId::es_b_right;
  const auto all = drawn(view);
  EXPECT_TRUE(says(all, view.title));
  EXPECT_TRUE(says(all, "best"));
  EXPECT_EQ(with_class(all, "rect", "p4").size(), 1U);
  EXPECT_EQ(with_class(all, "rect", "right").size(), 1U);
  view.title = std::string(400, 'x');
  EXPECT_FALSE(says(drawn(view), view.title));
}

TEST(SceneSvg, SameSceneSameBytes) {
  EXPECT_EQ(scene_svg(example()), scene_svg(example()));
}

TEST(SceneSvg, RefusesWhatDoesNotBelongTogether) {
  SceneView view = example();
  view.others.pop_back();
  EXPECT_THROW((void)scene_svg(view), ContractViolation);
  view = example();
  view.contacts[0].actor = 7;
  EXPECT_THROW((void)scene_svg(view), ContractViolation);
  EXPECT_THROW((void)scene_svg(example(), {60.0, 60.0}), ContractViolation);
}

}  // namespace
}  // namespace saca::report::scene_svg_test
