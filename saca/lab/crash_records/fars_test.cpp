#include "saca/lab/crash_records/fars.h"

#include <gmock/gmock.h>

#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::fars_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

std::string complaint(const ReleaseForTest& release) {
  const auto read = read_fars(release.folder());
  return read.has_value() ? "" : read.error().message;
}

TEST(Fars, JoinsTheThreeFilesByCrash) {
  const ReleaseForTest release("joins");
  const auto read = read_fars(release.folder());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read.value().crashes.size(), 2U);
  const FarsCrash& first = read.value().crashes[0];
  EXPECT_EQ(first.id, (CrashId{2016, 40001}));
  EXPECT_EQ(first.id.state(), 4);
  EXPECT_EQ(first.light, 2);
  ASSERT_EQ(first.vehicles.size(), 2U);
  EXPECT_EQ(first.vehicles[0].number, 1) << "by number, whatever the file's order";
  EXPECT_EQ(first.vehicles[1].travel_speed, 20);
  EXPECT_EQ(first.vehicles[1].event, 53);
  ASSERT_EQ(read.value().crashes[1].persons.size(), 1U);
  EXPECT_EQ(read.value().crashes[1].persons[0].struck_by, 1);
}

// The manual: TRAV_SP 998 not reported; LGT_COND 9, TYP_INT 99, VSPD_LIM 98, VNUM_LAN 9, AGE 998
// unknown.
TEST(Fars, TakesCodesThatSayNothingForNothing) {
  const ReleaseForTest release("unknown");
  const FarsRelease read = read_fars(release.folder()).value();
  const FarsCrash& second = read.crashes[1];
  EXPECT_FALSE(read.crashes[0].vehicles[0].travel_speed.has_value());
  EXPECT_FALSE(read.crashes[0].vehicles[0].avoidance.has_value());
  EXPECT_FALSE(second.light.has_value());
  EXPECT_FALSE(second.intersection.has_value());
  EXPECT_FALSE(second.vehicles[0].speed_limit.has_value());
  EXPECT_FALSE(second.vehicles[0].lanes.has_value());
  EXPECT_FALSE(second.persons[0].age.has_value());
}

TEST(Fars, HasTheYearInEachFileOrInOne) {
  const ReleaseForTest release("year");
  release.write("person.csv",
                "ST_CASE,Year,VEH_NO,PER_TYP,AGE,STR_VEH,LOCATION\n40001,2015,1,1,50,0,0\n"
                "40001,2016,1,1,51,0,0\n");
  const FarsRelease read = read_fars(release.folder()).value();
  ASSERT_EQ(read.crashes[0].persons.size(), 1U) << "that of 2015 is another crash";
  EXPECT_EQ(read.crashes[0].persons[0].age, 51);
  release.write("accident.csv",
                "ST_CASE,YEAR,LGT_COND,RELJCT2,TYP_INT\n40001,2016,2,1,1\n40001,2015,2,1,1\n");
  EXPECT_THAT(complaint(release), HasSubstr("column YEAR: want it here or one year"));
}

TEST(Fars, OfAnotherYearNamesFileColumnWantedAndGot) {
  const ReleaseForTest release("old");
  release.write("vehicle.csv", "STATE,ST_CASE,VEH_NO,BODY_TYP\n4,40001,1,4\n");
  EXPECT_THAT(complaint(release),
              HasSubstr("vehicle.csv: want a column TRAV_SP, got 4 columns without it: STATE"));
}

TEST(Fars, PassesOverBrokenRowsAndSaysSo) {
  const ReleaseForTest release("broken");
  release.write("vehicle.csv", std::string(ReleaseForTest::vehicle_names) +
                                   "\n4,40001,1,4,x,fast,45,1,2,1,1,1,53,1,25,6\n4,40001\n"
                                   "4,abc,1,4,x,20,45,1,2,1,1,1,53,1,25,6\n"
                                   "4,40001,1,4,x,20,45,1,2,1,1,1,53,1,25,6\n");
  const auto read = read_fars(release.folder());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value().crashes[0].vehicles.size(), 1U);
  EXPECT_THAT(read.value().notes, Contains(HasSubstr("3 of 4 rows were passed over")));
  EXPECT_THAT(read.value().notes, Contains(HasSubstr("column TRAV_SP: want a code, got `fast`")));
  EXPECT_THAT(read.value().notes, Contains(HasSubstr("1 of 2 crashes vehicle.csv has no row")));
}

TEST(Fars, TakesTheFirstOfTwoRowsOfOneVehicleAndSaysSo) {
  const ReleaseForTest release("twice");
  release.write("vehicle.csv", std::string(ReleaseForTest::vehicle_names) +
                                   "\n4,40001,1,4,x,30,45,1,2,1,1,1,53,1,25,6\n"
                                   "4,40001,1,4,x,20,45,1,2,1,1,1,53,1,25,6\n"
                                   "4,40002,1,4,x,20,45,1,2,1,1,1,53,1,25,6\n");
  const FarsRelease read = read_fars(release.folder()).value();
  ASSERT_EQ(read.crashes[0].vehicles.size(), 1U);
  EXPECT_EQ(read.crashes[0].vehicles[0].travel_speed, 30);
  EXPECT_THAT(read.notes, Contains(HasSubstr("1 of 3 rows were passed over")));
  EXPECT_THAT(read.notes,
              Contains(HasSubstr("column VEH_NO: want each vehicle of crash 40001 once, got 1")));
}

TEST(Fars, TellsOfCrashesThatAccidentCsvDoesNotHave) {
  const ReleaseForTest release("subset");
  release.write("accident.csv", "ST_CASE,YEAR,LGT_COND,RELJCT2,TYP_INT\n40002,2016,1,2,2\n");
  const FarsRelease read = read_fars(release.folder()).value();
  EXPECT_EQ(read.crashes.size(), 2U);
  EXPECT_THAT(read.notes, Contains(HasSubstr("1 of 2 crashes accident.csv has no row")));
}

TEST(Fars, RefusesFoldersWithoutFilesAndEmptyFiles) {
  EXPECT_FALSE(read_fars("no/such/folder").has_value());
  const ReleaseForTest release("empty");
  release.write("person.csv", "");
  EXPECT_THAT(complaint(release), HasSubstr("person.csv: want a column ST_CASE"));
  release.remove("person.csv");
  EXPECT_THAT(complaint(release), HasSubstr("want one file person.csv, got 0"));
  release.write("PERSON.CSV", "ST_CASE,VEH_NO,PER_TYP,AGE,STR_VEH,LOCATION\n40001,1,1,50,0,0\n");
  EXPECT_EQ(complaint(release), "");
}

TEST(Fars, JoinsReleasesAndRefusesACrashInTwo) {
  FarsRelease one;
  one.crashes = {slower_ahead()};
  FarsRelease other = one;
  other.crashes[0].id.number = 530001;
  const auto both = joined({other, one});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both.value().crashes[0].id.number, 40001);
  EXPECT_THAT(joined({one, one}).error().message,
              StartsWith("want each crash in one folder, got ST_CASE 40001 of 2016 in two"));
}

}  // namespace
}  // namespace saca::crash_records::fars_test
