#include "saca/lab/families/splits.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "saca/base/core/file.h"

namespace saca::families::splits_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::string_view splits_text = R"(schema = "saca.splits/1"
[seeds]
tuning = 11
calibration = 12
test = 13
[[test_only]]
family = "merge"
)";

class Splitting : public testing::Test {
 protected:
  Splits splits_ = read_splits(splits_text, "s.toml").value();
  TestLog log_{std::filesystem::path(testing::TempDir()) /
                   testing::UnitTest::GetInstance()->current_test_info()->name() / "test.log",
               "table 2"};
  void SetUp() override { std::filesystem::remove_all(log_.path.parent_path()); }
};

TEST_F(Splitting, EachSplitHasItsSeed) {
  EXPECT_EQ(seed_for(splits_, Split::tuning, "crossing", {}).value(), 11U);
  EXPECT_EQ(seed_for(splits_, Split::calibration, "crossing", {}).value(), 12U);
  EXPECT_EQ(seed_for(splits_, Split::test, "crossing", log_).value(), 13U);
}

TEST_F(Splitting, TheTestSplitIsNotDrawnUnnoted) {
  const auto refused = seed_for(splits_, Split::test, "crossing", {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("name a log"));
}

TEST_F(Splitting, EveryUseOfTheTestSplitIsNoted) {
  (void)seed_for(splits_, Split::test, "crossing", log_).value();
  (void)seed_for(splits_, Split::test, "merge", log_).value();
  (void)seed_for(splits_, Split::tuning, "crossing", log_).value();
  EXPECT_EQ(read_file(log_.path).value(), "table 2: family crossing\ntable 2: family merge\n");
}

TEST_F(Splitting, ALogThatCannotBeWrittenStopsTheDraw) {
  std::filesystem::create_directories(log_.path);  // a folder of that name
  const auto refused = seed_for(splits_, Split::test, "crossing", log_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unwritable);
}

TEST_F(Splitting, AFileThatIsNoLogStaysAsItWas) {
  const std::string text = "a: family b\n[seeds]\n";
  std::filesystem::create_directories(log_.path.parent_path());
  ASSERT_EQ(write_file(log_.path, text), std::nullopt);
  const auto refused = seed_for(splits_, Split::test, "crossing", log_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::malformed);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("test.log:2: want"), HasSubstr("[seeds]")));
  EXPECT_EQ(read_file(log_.path).value(), text);
}

TEST_F(Splitting, APurposeIsOneLine) {
  log_.purpose = "table 2\nand 3";
  EXPECT_EQ(seed_for(splits_, Split::test, "crossing", log_).value(), 13U);
  EXPECT_EQ(seed_for(splits_, Split::test, "crossing", log_).value(), 13U);
}

TEST_F(Splitting, SomeFamiliesAreForTheTestAlone) {
  const auto refused = seed_for(splits_, Split::tuning, "merge", {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("merge"), HasSubstr("tuning")));
}

std::string complaint(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto splits = read_splits(text, "s.toml");
  return splits.has_value() ? "" : splits.error().message;
}

TEST(Splits, RefuseWhatIsWrong) {
  const std::string text(splits_text);
  EXPECT_THAT(complaint(text, "splits/1", "splits/2"), HasSubstr("s.toml:1: schema: want"));
  EXPECT_THAT(complaint(text, "tuning = 11", "tuning = 13"), HasSubstr("13 again"));
  EXPECT_THAT(complaint(text, "tuning = 11", "tuning = 0"), HasSubstr("s.toml:3: tuning: want"));
  EXPECT_THAT(complaint(text, "tuning = 11", "training = 11"), HasSubstr("tuning"));
  EXPECT_THAT(complaint(text, "family = ", "families = "), HasSubstr("family"));
}

Suite mixture() {
  return {"mixed", "", {{"a", 1.0, "x"}, {"b", 3.0, "x"}, {"c", 6.0, "x"}}};
}

// The golden-ratio sequence fills an interval to within about 1 / n of its length.
TEST(Suites, MembersComeAsOftenAsTheirWeightsSay) {
  std::array<int, 3> counts{};
  for (std::uint64_t k = 0; k < 1000; ++k) {
    ++counts[member_of(mixture(), k)];
  }
  EXPECT_NEAR(counts[0], 100, 3);
  EXPECT_NEAR(counts[1], 300, 3);
  EXPECT_NEAR(counts[2], 600, 3);
}

TEST(Suites, RefuseWhatIsWrong) {
  const auto why = [](const std::string& text) -> std::string {
    const auto suites = read_suites(text, "u.toml");
    return suites.has_value() ? std::string() : suites.error().message;
  };
  const std::string head = "schema = \"saca.suites/1\"\n[[suites]]\nname=\"n\"\nwhy=\"w\"\n";
  const auto member = [&](const std::string& weight, const std::string& source) {
    std::string text = head;
    text += "[[suites.members]]\nfamily=\"a\"\nweight=";
    text += weight;
    text += "\nsource=\"";
    text += source;
    return text + "\"\n";
  };
  const std::string bus = "[[suites.cues]]\nkind=\"bus_at_stop\"\n";
  EXPECT_THAT(why(member("1", "x") + bus + bus), HasSubstr("kind: want each kind once"));
  EXPECT_THAT(why(member("1", "x") + "[[suites.cues]]\nkind=\"tram\"\n"),
              HasSubstr("kind: want school_zone"));
  EXPECT_THAT(why("schema = \"saca.suites/1\"\n"), HasSubstr("at least one suite"));
  EXPECT_THAT(why(head), HasSubstr("at least one family"));
  EXPECT_THAT(why(member("0", "s")), AllOf(HasSubstr("u.toml:7"), HasSubstr("weight")));
  EXPECT_THAT(why(member("1", "")), HasSubstr("who says so"));
  EXPECT_THAT(why(member("1", "s")), testing::IsEmpty());
}

}  // namespace
}  // namespace saca::families::splits_test
