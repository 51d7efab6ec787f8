#include "saca/lab/crash_records/roles.h"

#include <gmock/gmock.h>

#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::roles_test {
namespace {

using collision::Face;
using families::FamilyKind;

Roles roles(const FarsCrash& crash) {
  const auto found = roles_of(crash, shipped_codes());
  EXPECT_TRUE(std::holds_alternative<Roles>(found));
  return std::holds_alternative<Roles>(found) ? std::get<Roles>(found) : Roles{};
}

NoRoles why_none(const FarsCrash& crash) {
  const auto found = roles_of(crash, shipped_codes());
  EXPECT_TRUE(std::holds_alternative<NoRoles>(found));
  return std::get<NoRoles>(found);
}

TEST(Roles, TheEgoIsWhoRunsIntoTheOneAhead) {
  FarsCrash crash = slower_ahead();
  std::swap(crash.vehicles[0], crash.vehicles[1]);
  const Roles found = roles(crash);
  EXPECT_EQ(found.family, CrashFamily::rear_end);
  EXPECT_EQ(found.kind, FamilyKind::slower_lead);
  EXPECT_EQ(found.ego, 1U);
  EXPECT_EQ(found.other, 0U);
  EXPECT_EQ(found.struck, Face::front);
}

// Of crossing paths the manual says from where the one came who strikes, and which side of the
// other is struck.
TEST(Roles, CrossingPathsTellFromWhereAndWhichSide) {
  const auto crossing = [](int ego_type, int ego_event, int other_type, int other_event) {
    return roles(
        crash_record({car_record(1, ego_type, ego_event), car_record(2, other_type, other_event)}));
  };
  const Roles struck_right = crossing(87, 66, 86, 17);
  EXPECT_EQ(struck_right.ego, 0U);
  EXPECT_EQ(struck_right.from_left, false);
  EXPECT_EQ(struck_right.struck, Face::right);
  const Roles strikes_from_right = crossing(87, 17, 86, 66);
  EXPECT_EQ(strikes_from_right.ego, 1U) << "whom the other got in the way of";
  EXPECT_EQ(strikes_from_right.from_left, true) << "who comes from its left";
  EXPECT_EQ(strikes_from_right.struck, Face::front);
  const Roles struck_left = crossing(89, 66, 88, 17);
  EXPECT_EQ(struck_left.from_left, true);
  EXPECT_EQ(struck_left.struck, Face::left);
}

TEST(Roles, WhoChangesLaneComesFromTheOtherSide) {
  EXPECT_EQ(roles(crash_record({car_record(1, 45, 60), car_record(2, 46, 11)})).from_left, true);
  EXPECT_EQ(roles(crash_record({car_record(1, 45, 61), car_record(2, 47, 10)})).from_left, false);
}

TEST(Roles, PeopleOutsideVehiclesAreStruckByTheEgo) {
  const Roles walker = roles(struck_walker());
  EXPECT_EQ(walker.family, CrashFamily::pedestrian);
  EXPECT_EQ(walker.person, 0U);
  EXPECT_FALSE(walker.other.has_value());
  FarsCrash crash = struck_walker();
  crash.persons[0].type = 6;
  EXPECT_EQ(roles(crash).kind, FamilyKind::cyclist);
  crash.persons[0].struck_by = std::nullopt;
  EXPECT_EQ(why_none(crash), NoRoles::type_not_covered);
}

TEST(Roles, PlacesAreToldByJunctionTrafficwayAndLimit) {
  FarsCrash crash = slower_ahead();
  EXPECT_EQ(roles(crash).place, Place::road);
  crash.vehicles[0].speed_limit = 65;
  EXPECT_EQ(roles(crash).place, Place::highway);
  crash.junction = 3;
  EXPECT_EQ(roles(crash).place, Place::junction);
  crash.vehicles[1].trafficway = 6;
  EXPECT_EQ(roles(crash).place, Place::ramp);
  EXPECT_EQ(roles(crash).family, CrashFamily::ramp);
  EXPECT_EQ(roles(crash).kind, FamilyKind::slower_lead) << "it is played all the same";
  FarsCrash turning = crash_record({car_record(1, 69, 62), car_record(2, 68, 15)});
  turning.junction = std::nullopt;
  EXPECT_EQ(roles(turning).place, Place::junction);
}

TEST(Roles, TellsWhyThereAreNone) {
  EXPECT_EQ(why_none(crash_record({car_record(1, 1, 13)})), NoRoles::type_not_covered);
  FarsCrash rider = slower_ahead();
  rider.vehicles[0].body = 80;
  EXPECT_EQ(why_none(rider), NoRoles::ego_is_no_car);
  EXPECT_EQ(crash_family_of(rider), CrashFamily::rear_end) << "it counts all the same";
  FarsCrash unknown = slower_ahead();
  unknown.vehicles[1].body = std::nullopt;
  EXPECT_EQ(why_none(unknown), NoRoles::other_unknown);
  FarsCrash alone = slower_ahead();
  alone.vehicles.pop_back();
  EXPECT_EQ(why_none(alone), NoRoles::other_unknown);
  EXPECT_EQ(crash_family_of(crash_record({car_record(1, 1, 13)})), std::nullopt);
}

// IMPACT1: clock positions, 12 at the front, and the parts of the sides.
TEST(Roles, ImpactsAreOnOneOfFourSides) {
  EXPECT_EQ(face_of_impact(12), Face::front);
  EXPECT_EQ(face_of_impact(1), Face::front);
  EXPECT_EQ(face_of_impact(3), Face::right);
  EXPECT_EQ(face_of_impact(6), Face::rear);
  EXPECT_EQ(face_of_impact(9), Face::left);
  EXPECT_EQ(face_of_impact(62), Face::left);
  EXPECT_EQ(face_of_impact(83), Face::right);
  EXPECT_FALSE(face_of_impact(14).has_value()) << "from below";
  EXPECT_FALSE(face_of_impact(std::nullopt).has_value());
}

TEST(Roles, HaveNames) {
  for (std::size_t i = 0; i < num_crash_families; ++i) {
    const auto family = static_cast<CrashFamily>(i);
    EXPECT_EQ(crash_family_from(name(family)), family);
  }
  EXPECT_EQ(name(Place::ramp), "ramp");
  EXPECT_EQ(name(NoRoles::ego_is_no_car), "ego_is_no_car");
}

}  // namespace
}  // namespace saca::crash_records::roles_test
