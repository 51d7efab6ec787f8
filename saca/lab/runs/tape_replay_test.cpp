#include "saca/lab/runs/tape_replay.h"

#include <gmock/gmock.h>

#include "saca/runtime/tape_for_test.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::runs::tape_replay_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class AReplay : public testing::Test {
 protected:
  /// A short drive as this program would have recorded it.
  [[nodiscard]] runtime::TapeFile tape() {
    runtime::PlanesSetup setup = drive_.setup();
    runtime::TapeFile tape{.header = runtime::tape_header(setup, intent::shipped_model()),
                           .content = drive_.driven(setup, 120)};
    tape.header.program = "1.2.3";
    tape.header.car = "x";
    tape.header.num_draws = arbitration::usual_draws;
    return tape;
  }
  [[nodiscard]] ReplayMeans means() {
    return {.car = &drive_.car,
            .harm = &drive_.harm,
            .intent = &intent::shipped_model(),
            .cues = nullptr,
            .program = "1.2.3",
            .atlas = [this]() -> Result<atlas::Atlas> {
              ++asked_;
              return Error{Error::Code::unreadable, "x.atlas: nothing"};
            }};
  }

  runtime::TapedDrive drive_;
  int asked_ = 0;
};

TEST_F(AReplay, OfADriveComesOutTheSame) {
  const auto replay = replayed(tape(), "a.tape", means());
  ASSERT_TRUE(replay.has_value()) << replay.error().message;
  EXPECT_FALSE(replay.value().first.has_value());
  EXPECT_GE(replay.value().answers.recorded, 100U);
  EXPECT_EQ(replay.value().answers.same, replay.value().answers.recorded);
  EXPECT_EQ(asked_, 0);
}

TEST_F(AReplay, IsRefusedWhereSomethingElseWouldComeOut) {
  ReplayMeans other = means();
  other.program = "1.2.4";
  EXPECT_THAT(replayed(tape(), "a.tape", other).error().message,
              AllOf(StartsWith("a.tape: "), HasSubstr("1.2.3"), HasSubstr("1.2.4")));
  other = means();
  manoeuvre::Car heavier = drive_.car;
  heavier.mass += 1.0;
  other.car = &heavier;
  EXPECT_THAT(replayed(tape(), "a.tape", other).error().message, StartsWith("a.tape: "));
}

TEST_F(AReplay, AsksForAnAtlasOnlyWhereThereWasOneAndAllElseIsTheSame) {
  runtime::TapeFile with_atlas = tape();
  with_atlas.header.atlas = "0123456789abcdef";
  ReplayMeans other = means();
  other.program = "1.2.4";
  EXPECT_THAT(replayed(with_atlas, "a.tape", other).error().message, StartsWith("a.tape: "));
  EXPECT_EQ(asked_, 0);
  EXPECT_EQ(replayed(with_atlas, "a.tape", means()).error().message, "x.atlas: nothing");
  EXPECT_EQ(asked_, 1);
}

}  // namespace
}  // namespace saca::runs::tape_replay_test
