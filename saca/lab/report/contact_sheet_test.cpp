#include "saca/lab/report/contact_sheet.h"

#include <gtest/gtest.h>

#include <set>

#include "saca/base/core/contract.h"
#include "saca/lab/report/xml_for_test.h"

namespace saca::report::contact_sheet_test {
namespace {

SceneView ego_alone(double way, const std::string& title) {
  SceneView view;
  view.title = title;
  view.scene.ego_footprint = {world::Shape::box, 4.7, 1.9, -0.1};
  view.ego = {.start = 0.0, .step = 0.5, .X_WA = {{}, {{way, 0.0}, 0.0}}};
  return view;
}

ContactSheet sheet_of(std::size_t num_scenes) {
  ContactSheet sheet;
  sheet.heading = "Test & more";
  sheet.lines = {"what it shows"};
  for (std::size_t i = 0; i < num_scenes; ++i) {
    const double way = 5.0 * static_cast<double>(i + 1);
    sheet.scenes.push_back(ego_alone(way, "scene " + std::to_string(i)));
  }
  return sheet;
}

/// Nested parts that hold thumbnails, not pictures.
std::vector<XmlElement> thumbnails(const std::vector<XmlElement>& all) {
  std::vector<XmlElement> found;
  for (const XmlElement& element : all) {
    if (element.name == "svg" && element.depth == 1) {
      found.push_back(element);
    }
  }
  return found;
}

TEST(ContactSheet, ScenesStandInReadingOrderWithoutOverlap) {
  const ContactSheet sheet = sheet_of(7);
  const auto all = xml_elements(contact_sheet(sheet));
  const auto parts = thumbnails(all);
  ASSERT_EQ(parts.size(), 7U);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_TRUE(says(all, "scene " + std::to_string(i)));
    EXPECT_LE(xml_number(parts[i], "x") + sheet.thumbnail.width, xml_number(all[0], "width"));
    EXPECT_LE(xml_number(parts[i], "y") + sheet.thumbnail.height, xml_number(all[0], "height"));
    if (i > 0 && i % 4 != 0) {
      EXPECT_EQ(xml_number(parts[i], "y"), xml_number(parts[i - 1], "y"));
      EXPECT_GE(xml_number(parts[i], "x"), xml_number(parts[i - 1], "x") + sheet.thumbnail.width);
    }
  }
  EXPECT_EQ(xml_number(parts[4], "x"), xml_number(parts[0], "x"));
  EXPECT_GE(xml_number(parts[4], "y"), xml_number(parts[0], "y") + sheet.thumbnail.height);
}

TEST(ContactSheet, IdsAreUnique) {
  std::set<std::string> ids;
  for (const XmlElement& element : xml_elements(contact_sheet(sheet_of(5)))) {
    const auto id = element.attributes.find("id");
    if (id != element.attributes.end()) {
      EXPECT_TRUE(ids.insert(id->second).second) << id->second;
    }
  }
}

TEST(ContactSheet, OnTheSameGroundAMetreIsAsLongInAll) {
  ContactSheet sheet = sheet_of(3);
  const auto lengths = [&] {
    std::vector<double> all;
    for (const XmlElement& body :
         with_class(xml_elements(contact_sheet(sheet)), "polygon", "ego body")) {
      const auto points = xml_points(body);
      all.push_back(norm(points[0] - points[1]));
    }
    return all;
  };
  sheet.scenes.push_back(ego_alone(60.0, "far"));
  const auto own = lengths();
  EXPECT_GT(own[0], 1.5 * own[3]);
  sheet.same_ground = true;
  const auto same = lengths();
  for (const double length : same) {
    EXPECT_NEAR(length, same[0], 0.02);
  }
}

TEST(ContactSheet, TheLegendNamesWhoOccurs) {
  ContactSheet sheet = sheet_of(1);
  SceneView& view = sheet.scenes[0];
  view.scene.actors.push_back({.id = 1,
                               .kind = world::ActorKind::bicycle,
                               .footprint = {world::Shape::box, 1.8, 0.6, 0.0},
                               .X_WA = {{8.0, 0.0}, 0.0}});
  view.others = {{.start = 0.0, .step = 0.5, .X_WA = {{{8.0, 0.0}, 0.0}}}};
  auto all = xml_elements(contact_sheet(sheet));
  EXPECT_TRUE(says(all, "bicycle"));
  EXPECT_FALSE(says(all, "truck"));
  EXPECT_FALSE(says(all, "first contact"));
  view.contacts.push_back({});
  all = xml_elements(contact_sheet(sheet));
  EXPECT_TRUE(says(all, "first contact"));
  EXPECT_FALSE(says(all, "later contact"));
}

TEST(ContactSheet, RefusesNothingToShow) {
  EXPECT_THROW((void)contact_sheet({}), ContractViolation);
  ContactSheet sheet = sheet_of(1);
  sheet.columns = 0;
  EXPECT_THROW((void)contact_sheet(sheet), ContractViolation);
}

}  // namespace
}  // namespace saca::report::contact_sheet_test
