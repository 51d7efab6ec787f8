#include "saca/lab/cases/case_sources.h"

#include <gmock/gmock.h>

#include "saca/lab/crash_records/records_for_test.h"

namespace saca::cases::case_sources_test {
namespace {

using crash_records::CrashFamily;
using testing::HasSubstr;

const CrashCount& of(const CaseSources& sources, CrashFamily family) {
  return sources.counts.at(static_cast<std::size_t>(family));
}

// A car that ran into a slower one, and one that struck somebody on foot.
class CaseSourcesTest : public testing::Test {
 protected:
  [[nodiscard]] Result<CaseSources> open(const std::optional<int>& count = std::nullopt) const {
    return open_case_sources(".", {release_.folder().string()}, "", count);
  }
  crash_records::ReleaseForTest release_{"case_sources"};
};

TEST_F(CaseSourcesTest, CountsEachFamilyAndMakesProspects) {
  const CaseSources sources = open().value();
  EXPECT_EQ(sources.release.crashes.size(), 2U);
  EXPECT_EQ(of(sources, CrashFamily::rear_end).crashes, 1);
  EXPECT_EQ(of(sources, CrashFamily::pedestrian).crashes, 1);
  EXPECT_EQ(of(sources, CrashFamily::head_on).crashes, 0);
  ASSERT_EQ(sources.prospects.size(), 2U);
  EXPECT_EQ(sources.prospects[0].roles.family, CrashFamily::rear_end);
  EXPECT_EQ(sources.prospects[0].family.name, "fars_2016_40001");
  EXPECT_EQ(sources.prospects[1].crash, 1U);
  EXPECT_TRUE(sources.events.empty());
}

// The ego's body type is a motorcycle's in the one, in the other it was faster than 40 m/s.
TEST_F(CaseSourcesTest, SaysWhyNoEncounterIsMade) {
  const std::string names = crash_records::ReleaseForTest::vehicle_names;
  release_.write("vehicle.csv", names +
                                    "\n4,40001,2,4,\"Sedan\",20,45,1,2,1,1,1,53,1,25,6\n"
                                    "4,40001,1,80,\"Motorcycle\",998,45,1,2,1,2,1,51,99,24,12\n"
                                    "4,40002,1,4,\"Sedan\",120,98,1,9,1,1,1,80,1,13,12\n");
  const CaseSources sources = open().value();
  EXPECT_EQ(of(sources, CrashFamily::rear_end).crashes, 1);
  EXPECT_EQ(of(sources, CrashFamily::rear_end).ego_is_no_car, 1);
  EXPECT_EQ(of(sources, CrashFamily::pedestrian).not_playable, 1);
  EXPECT_TRUE(sources.prospects.empty());
}

// Two of the rear-end kind and one on foot: of two, one of each.
TEST_F(CaseSourcesTest, FewerAreOfTheFamiliesInTurn) {
  release_.write("accident.csv",
                 "STATE,ST_CASE,YEAR,LGT_COND,RELJCT2,TYP_INT\n4,40000,2016,2,1,1\n"
                 "4,40001,2016,2,1,1\n4,40002,2016,9,2,99\n");
  release_.write("vehicle.csv", std::string(crash_records::ReleaseForTest::vehicle_names) +
                                    "\n4,40000,2,4,\"Sedan\",20,45,1,2,1,1,1,53,1,25,6\n"
                                    "4,40000,1,4,\"Sedan\",40,45,1,2,1,2,1,51,99,24,12\n"
                                    "4,40001,2,4,\"Sedan\",20,45,1,2,1,1,1,53,1,25,6\n"
                                    "4,40001,1,4,\"Sedan\",40,45,1,2,1,2,1,51,99,24,12\n"
                                    "4,40002,1,4,\"Sedan\",35,98,1,9,1,1,1,80,1,13,12\n");
  release_.write("person.csv",
                 "STATE,ST_CASE,VEH_NO,PER_TYP,AGE,STR_VEH,LOCATION\n4,40000,1,1,50,0,0\n"
                 "4,40001,1,1,50,0,0\n4,40002,0,5,998,1,11\n");
  const CaseSources sources = open(2).value();
  ASSERT_EQ(sources.prospects.size(), 2U);
  EXPECT_EQ(sources.prospects[0].family.name, "fars_2016_40000");
  EXPECT_EQ(sources.prospects[1].roles.family, CrashFamily::pedestrian);
  EXPECT_EQ(of(sources, CrashFamily::rear_end).crashes, 2) << "all are counted";
}

TEST_F(CaseSourcesTest, NamesWhatCannotBeRead) {
  EXPECT_THAT(open_case_sources(".", {"no_such_folder"}, "", {}).error().message,
              HasSubstr("no_such_folder"));
  EXPECT_THAT(open_case_sources("no_such_root", {}, "", {}).error().message,
              HasSubstr("fars_codes.toml"));
  EXPECT_THAT(open_case_sources(".", {}, "no_such_study", {}).error().message,
              HasSubstr("no_such_study"));
}

}  // namespace
}  // namespace saca::cases::case_sources_test
