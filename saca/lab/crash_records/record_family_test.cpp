#include "saca/lab/crash_records/record_family.h"

#include <gmock/gmock.h>

#include "saca/base/core/units.h"
#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::record_family_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const BaseFamilies& base() {
  static const BaseFamilies families = load_base_families("scenarios/families").value();
  return families;
}

Result<families::Family> made_of(const FarsCrash& crash) {
  return family_of(crash, std::get<Roles>(roles_of(crash, shipped_codes())), shipped_codes(),
                   base());
}

families::FamilyRange range(const FarsCrash& crash, const std::string& key) {
  const auto family = made_of(crash);
  EXPECT_TRUE(family.has_value()) << family.error().message;
  return family.value().ranges.at(key);
}

// 45 mph are 20.1 m/s; right to 10 %.
TEST(RecordFamily, SpeedsAreThoseOfTheRecordWithTheirUncertainty) {
  const families::FamilyRange ego = range(slower_ahead(), "ego_speed_mps");
  EXPECT_NEAR(ego.min, from_mph(40.5), 1e-9);
  EXPECT_NEAR(ego.max, from_mph(49.5), 1e-9);
  EXPECT_THAT(ego.source, StartsWith("recorded: ego's TRAV_SP 45 mph"));
  const families::FamilyRange lead = range(slower_ahead(), "lead_mps");
  EXPECT_NEAR(lead.min, from_mph(17.5), 1e-9) << "20 may have been rounded to 5 mph";
  EXPECT_NEAR(lead.max, from_mph(22.5), 1e-9);
}

TEST(RecordFamily, ASpeedThatIsNotKnownIsAShareOfTheLimit) {
  FarsCrash crash = slower_ahead();
  crash.vehicles[0].travel_speed = std::nullopt;
  const families::FamilyRange ego = range(crash, "ego_speed_mps");
  const Span share = shipped_codes().speed_over_limit(SpeedRole::straight);
  EXPECT_NEAR(ego.min, share.min * from_mph(45.0), 1e-9);
  EXPECT_NEAR(ego.max, share.max * from_mph(45.0), 1e-9);
  EXPECT_THAT(ego.source, StartsWith("assumption: ego's TRAV_SP is not known"));
  crash.vehicles[0].speed_limit = std::nullopt;
  EXPECT_THAT(
      range(crash, "ego_speed_mps").source,
      StartsWith(base().at(families::FamilyKind::slower_lead).ranges.at("ego_speed_mps").source));
}

TEST(RecordFamily, WhoCameOverDidNotStand) {
  FarsCrash crash = crash_record({car_record(1, 51, 62), car_record(2, 50, 10)});
  crash.vehicles[1].travel_speed = 0;
  const families::FamilyRange other = range(crash, "other_speed_mps");
  EXPECT_GT(other.min, 10.0);
  EXPECT_THAT(other.source, HasSubstr("TRAV_SP 0 mph is not believed"));
}

TEST(RecordFamily, WhoStandsStands) {
  const FarsCrash crash = crash_record({car_record(1, 20, 50), car_record(2, 21, 53)});
  EXPECT_EQ(range(crash, "lead_mps").max, 0.0);
  EXPECT_THAT(range(crash, "lead_mps").source, HasSubstr("ACC_TYPE 20"));
}

TEST(RecordFamily, TheOtherIsTheVehicleOfTheRecord) {
  FarsCrash crash = slower_ahead();
  crash.vehicles[1].body = 66;
  EXPECT_EQ(range(crash, "truck_share").min, 1.0);
  EXPECT_EQ(range(crash, "van_share").max, 0.0);
  crash.vehicles[1].body = 80;
  EXPECT_EQ(range(crash, "motorcycle_share").min, 1.0);
  EXPECT_EQ(range(crash, "truck_share").max, 0.0);
}

TEST(RecordFamily, TheRoadIsThatOfTheRecord) {
  FarsCrash crash = slower_ahead();
  EXPECT_EQ(range(crash, "oncoming_share").min, 1.0) << "two lanes, two ways";
  EXPECT_EQ(range(crash, "right_lane_share").max, 0.0);
  EXPECT_NEAR(range(crash, "grip").max, shipped_codes().grip(1)->max, 1e-12);
  crash.vehicles[0].surface = 4;
  EXPECT_LE(range(crash, "grip").max, 0.3);
  crash.vehicles[0].surface = std::nullopt;
  EXPECT_THAT(range(crash, "grip").source, StartsWith("assumption"));
  crash.vehicles[0].trafficway = 3;
  EXPECT_EQ(range(crash, "oncoming_share").max, 0.0) << "divided";
  crash.vehicles[0].lanes = 1;
  EXPECT_EQ(range(crash, "left_lane_share").max, 0.0);
}

// The striking one's front is where the other's side is; the struck one's side is where the other's
// front is, later by half of the other's length at least.
TEST(RecordFamily, WhoIsStruckIsPassedByLater) {
  const auto late = [](int ego, int other) {
    return range(crash_record({car_record(1, ego, 66), car_record(2, other, 17)}), "late_s");
  };
  EXPECT_NEAR(late(86, 87).min + late(86, 87).max, 0.0, 1e-12);
  EXPECT_GT(late(89, 88).min, 0.5 * 4.02 / from_mph(45.0));
}

TEST(RecordFamily, TurnsGoWhereTheCrashTypeSays) {
  const auto turn = [](int ego, int other, const char* key) {
    return range(crash_record({car_record(1, ego, 62), car_record(2, other, 15)}), key);
  };
  EXPECT_EQ(turn(69, 68, "from_deg").min, 180.0);
  EXPECT_EQ(turn(83, 82, "from_deg").min, 90.0) << "heads to the left: comes from the right";
  EXPECT_EQ(turn(79, 78, "turn_deg").max, -90.0);
  EXPECT_LE(turn(69, 68, "other_speed_mps").max, 6.0) << "45 mph is no speed of a turn";
}

TEST(RecordFamily, PeopleWhoWereStruckWalkedOn) {
  FarsCrash crash = struck_walker();
  EXPECT_EQ(range(crash, "chance_stop").max, 0.0);
  EXPECT_EQ(range(crash, "second_share").max, 0.0);
  crash.persons.push_back(crash.persons[0]);
  EXPECT_EQ(range(crash, "second_share").min, 1.0);
  crash.persons[0].age = 70;
  EXPECT_LT(range(crash, "walk_mps").max, 2.0);
}

TEST(RecordFamily, WhoRanIntoTheOneAheadWasFaster) {
  FarsCrash crash = slower_ahead();
  crash.vehicles[0].travel_speed = std::nullopt;
  crash.vehicles[1].travel_speed = 40;
  EXPECT_NEAR(range(crash, "ego_speed_mps").min, from_mph(40.0) + 4.0, 1e-9);
  EXPECT_THAT(range(crash, "ego_speed_mps").source, HasSubstr("faster than the one ahead"));
}

TEST(RecordFamily, NobodyComesThroughABarrier) {
  EXPECT_GT(range(slower_ahead(), "barrier_share").max, 0.0);
  EXPECT_EQ(range(struck_walker(), "barrier_share").max, 0.0);
  const FarsCrash crossing = crash_record({car_record(1, 89, 66), car_record(2, 88, 17)});
  EXPECT_EQ(range(crossing, "barrier_share").max, 0.0);
  EXPECT_EQ(range(crossing, "trees_share").max, 0.0);
}

TEST(RecordFamily, ASlowEgoStrikesNoCyclistFromBehind) {
  FarsCrash crash = struck_walker();
  crash.persons[0].type = 6;
  EXPECT_GT(range(crash, "along_share").max, 0.0);
  crash.vehicles[0].travel_speed = 10;
  EXPECT_EQ(range(crash, "along_share").max, 0.0);
}

TEST(RecordFamily, IsNamedByItsRecord) {
  const families::Family family = made_of(slower_ahead()).value();
  EXPECT_EQ(family.name, "fars_2016_40001");
  EXPECT_EQ(family.title, "same direction, rear end: slower: Arizona 2016, case 40001");
}

TEST(RecordFamily, RefusesWhatCannotBePlayed) {
  FarsCrash crash = slower_ahead();
  crash.vehicles[0].travel_speed = 1;
  EXPECT_THAT(made_of(crash).error().message, HasSubstr("less than 2.3 m/s"));
  crash.vehicles[0].travel_speed = 120;
  EXPECT_THAT(made_of(crash).error().message, HasSubstr("more than 40 m/s"));
  crash = slower_ahead();
  crash.vehicles[1].travel_speed = 60;
  EXPECT_THAT(made_of(crash).error().message, HasSubstr("the ego not faster"));
}

// Every number has bounds that the families' reader asks for: a sample of each kind can be drawn.
TEST(RecordFamily, GivesEncountersThatCanBeDrawn) {
  for (const FarsCrash& crash : {slower_ahead(), struck_walker(),
                                 crash_record({car_record(1, 28, 52), car_record(2, 29, 53)}),
                                 crash_record({car_record(1, 45, 60), car_record(2, 46, 11)}),
                                 crash_record({car_record(1, 51, 62), car_record(2, 50, 10)}),
                                 crash_record({car_record(1, 89, 66), car_record(2, 88, 17)}),
                                 crash_record({car_record(1, 69, 62), car_record(2, 68, 15)}),
                                 crash_record({car_record(1, 83, 67), car_record(2, 82, 15)})}) {
    const families::Family family = made_of(crash).value();
    const auto sample = families::sample(family, 1, 1, "compact_rwd_ev", scenario::standard_ego);
    EXPECT_TRUE(sample.has_value()) << family.title << ": " << sample.error().message;
  }
}

}  // namespace
}  // namespace saca::crash_records::record_family_test
