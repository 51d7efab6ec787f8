#include "saca/lab/crash_records/fars_codes.h"

#include <gmock/gmock.h>

#include "saca/base/core/file.h"
#include "saca/lab/crash_records/records_for_test.h"

namespace saca::crash_records::fars_codes_test {
namespace {

using testing::HasSubstr;
using world::ActorKind;

// Codes and words: FARS Analytical User's Manual, DOT HS 812 448.
TEST(FarsCodes, SayWhatTheManualSays) {
  const FarsCodes& codes = shipped_codes();
  EXPECT_EQ(codes.meaning("LGT_COND", 3), "dark - lighted");
  EXPECT_EQ(codes.meaning("P_CRASH1", 11), "turning left");
  EXPECT_EQ(codes.meaning("P_CRASH3", 6), "steering left");
  EXPECT_EQ(codes.meaning("ACC_TYPE", 20), "same direction, rear end: stopped");
  EXPECT_EQ(codes.meaning("STATE", 53), "Washington");
  EXPECT_EQ(codes.meaning("BODY_TYP", 31), "pickup");
  EXPECT_EQ(codes.meaning("VSURCOND", 2), "wet");
  EXPECT_EQ(codes.meaning("LGT_COND", std::nullopt), "not known");
  EXPECT_EQ(codes.meaning("LGT_COND", 77), "code 77");
  EXPECT_EQ(codes.meaning("NO_SUCH", 1), "code 1");
}

TEST(FarsCodes, TellWhichBodiesAreRoadUsers) {
  const FarsCodes& codes = shipped_codes();
  EXPECT_EQ(codes.kind_of_body(4), ActorKind::car);
  EXPECT_EQ(codes.kind_of_body(20), ActorKind::van);
  EXPECT_EQ(codes.kind_of_body(66), ActorKind::truck);
  EXPECT_EQ(codes.kind_of_body(80), ActorKind::motorcycle);
  EXPECT_EQ(codes.kind_of_body(95), std::nullopt) << "a golf cart";
  EXPECT_EQ(codes.kind_of_body(std::nullopt), std::nullopt);
}

TEST(FarsCodes, DryRoadsGripBetterThanWetOnesAndIce) {
  const FarsCodes& codes = shipped_codes();
  EXPECT_GT(codes.grip(1)->min + codes.grip(1)->max, codes.grip(2)->min + codes.grip(2)->max);
  EXPECT_GT(codes.grip(2)->min, codes.grip(4)->max);
  EXPECT_FALSE(codes.grip(99).has_value());
  EXPECT_FALSE(codes.grip(std::nullopt).has_value());
}

std::string complaint(const std::string& from, const std::string& to) {
  std::string text = read_file("data/crash_records/fars_codes.toml").value();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto codes = FarsCodes::read(text, "codes.toml");
  return codes.has_value() ? "" : codes.error().message;
}

TEST(FarsCodes, RefuseWhatIsWrongInTheFile) {
  EXPECT_THAT(complaint("saca.fars_codes/1", "saca.fars_codes/2"), HasSubstr("schema"));
  EXPECT_THAT(complaint("kind = \"van\"", "kind = \"boat\""), HasSubstr("got \"boat\""));
  EXPECT_THAT(complaint("grip_max = 0.95", "grip_max = 0.1"), HasSubstr("grip_max"));
  EXPECT_THAT(complaint("role = \"slower\"", "role = \"slow\""), HasSubstr("got \"slow\""));
  EXPECT_THAT(complaint("role = \"slower\"", "role = \"straight\""),
              HasSubstr("want one entry a role, 5, got 4"));
  EXPECT_THAT(complaint("code = 21", "code = 20"), HasSubstr("each code once, got 20 again"));
  EXPECT_FALSE(FarsCodes::load("no_such.toml").has_value());
}

TEST(FarsCodes, SpeedsAreSharesOfTheLimit) {
  const Span straight = shipped_codes().speed_over_limit(SpeedRole::straight);
  EXPECT_LT(straight.min, 1.0);
  EXPECT_GT(straight.max, 1.0);
  EXPECT_EQ(name(SpeedRole::changing_lane), "changing_lane");
}

}  // namespace
}  // namespace saca::crash_records::fars_codes_test
