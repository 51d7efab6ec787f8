#include "saca/runtime/tape_header.h"

#include <gmock/gmock.h>

#include <functional>

#include "saca/onboard/atlas/atlas_for_test.h"
#include "saca/runtime/tape_for_test.h"

namespace saca::runtime::tape_header_test {
namespace {

using testing::StartsWith;

TEST(TapeHeader, TellsWhatThePlanesAreMadeOf) {
  TapedDrive drive;
  PlanesSetup setup = drive.setup(Pace::real);
  setup.guard = reflex::Guard::none;
  setup.thresholds.trigger = 1.5;
  const TapeHeader header = tape_header(setup, intent::shipped_model());
  EXPECT_EQ(header.pace, Pace::real);
  EXPECT_FALSE(header.guarded);
  EXPECT_EQ(header.thresholds.trigger, 1.5);
  EXPECT_EQ(header.num_draws, arbitration::usual_draws);
  EXPECT_EQ(header.model, "off");
  EXPECT_FALSE(header.atlas.has_value());
}

TEST(TapeHeader, WhateverResultsDependOnHasADigestOfItsOwn) {
  TapedDrive drive;
  const TapeHeader here = tape_header(drive.setup(), intent::shipped_model());
  drive.car.mass += 1.0;
  drive.harm.killed_weight *= 1.5;
  PlanesSetup setup = drive.setup();
  setup.forecast.atlas = &atlas::small_atlas();
  const intent::CueLaw cues = intent::load_cue_law("data/cues.toml").value();
  setup.forecast.cues = &cues;
  const TapeHeader other = tape_header(setup, intent::shipped_model());
  EXPECT_NE(other.car_digest, here.car_digest);
  EXPECT_NE(other.harm_digest, here.harm_digest);
  EXPECT_NE(other.atlas, here.atlas);
  EXPECT_NE(other.cues, here.cues);
  EXPECT_EQ(other.intent_digest, here.intent_digest);
  EXPECT_EQ(tape_header(setup, intent::shipped_model()).atlas, other.atlas);
}

TEST(TapeHeader, WhatWasRecordedWithAnythingElseIsToldApart) {
  TapedDrive drive;
  TapeHeader here = tape_header(drive.setup(), intent::shipped_model());
  here.program = "0.1.0";
  EXPECT_EQ(mismatch(here, here), std::nullopt);
  const auto told = [&](const std::function<void(TapeHeader&)>& alter) {
    TapeHeader tape = here;
    alter(tape);
    return mismatch(tape, here)->message;
  };
  EXPECT_THAT(told([](TapeHeader& tape) { tape.program = "0.2.0"; }),
              StartsWith("program: recorded with 0.2.0, here it is 0.1.0"));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.level = "sse"; }), StartsWith("level: "));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.car_digest = "1"; }), StartsWith("car_digest: "));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.intent_digest = "1"; }),
              StartsWith("intent_digest: "));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.harm_digest = "1"; }), StartsWith("harm_digest: "));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.cues = "1"; }),
              StartsWith("cues_digest: recorded with 1, here it is none"));
  EXPECT_THAT(told([](TapeHeader& tape) { tape.atlas = "abc"; }),
              StartsWith("atlas_digest: recorded with abc, here it is none"));
}

// What they led to stands on the tape.
TEST(TapeHeader, AnotherPaceModelOrScenarioDoesNotMatter) {
  TapedDrive drive;
  const TapeHeader here = tape_header(drive.setup(), intent::shipped_model());
  TapeHeader tape = here;
  tape.pace = Pace::real;
  tape.model = "another";
  tape.memory = true;
  tape.scenario = "elsewhere";
  tape.costs.verdict = 1.0;
  EXPECT_EQ(mismatch(tape, here), std::nullopt);
}

}  // namespace
}  // namespace saca::runtime::tape_header_test
