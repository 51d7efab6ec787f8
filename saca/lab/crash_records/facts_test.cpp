#include "saca/lab/crash_records/facts.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::facts_test {
namespace {

std::string words(const std::vector<Fact>& facts, const std::string& about,
                  const std::string& key) {
  const auto found = std::find_if(facts.begin(), facts.end(), [&](const Fact& fact) {
    return fact.about == about && fact.key == key;
  });
  return found == facts.end() ? "no such fact" : found->words;
}

std::vector<Fact> facts(const FarsCrash& crash) {
  return facts_of(crash, std::get<Roles>(roles_of(crash, shipped_codes())), shipped_codes());
}

TEST(Facts, TellOfTheCrashTheEgoAndTheOther) {
  FarsCrash crash = slower_ahead();
  crash.vehicles[1].travel_speed = std::nullopt;
  const auto all = facts(crash);
  EXPECT_EQ(words(all, "crash", "LGT_COND"), "daylight");
  EXPECT_EQ(words(all, "crash", "VE_FORMS"), "2 vehicles");
  EXPECT_EQ(words(all, "ego", "TRAV_SP"), "45 mph");
  EXPECT_EQ(words(all, "ego", "VSURCOND"), "dry");
  EXPECT_EQ(words(all, "ego", "IMPACT1"), "front");
  EXPECT_EQ(words(all, "other", "TRAV_SP"), "not known");
  EXPECT_EQ(words(all, "other", "BODY_TYP"), "automobile");
  EXPECT_EQ(words(all, "person", "AGE"), "no such fact");
}

TEST(Facts, TellOfWhoWasStruck) {
  const auto all = facts(struck_walker());
  EXPECT_EQ(words(all, "person", "PER_TYP"), "pedestrian");
  EXPECT_EQ(words(all, "person", "AGE"), "30 years");
  EXPECT_EQ(words(all, "other", "VEH_NO"), "no such fact");
}

}  // namespace
}  // namespace saca::crash_records::facts_test
