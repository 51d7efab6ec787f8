#include "saca/lab/eval/suite_source.h"

#include <gmock/gmock.h>

#include <set>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::eval::suite_source_test {
namespace {

using testing::HasSubstr;

SuiteDraw draw_of(const std::string& suite, families::Split split = families::Split::tuning) {
  return {.scenarios = "scenarios",
          .suite = suite,
          .split = split,
          .test_log = std::nullopt,
          .car = "compact_rwd_ev",
          .footprint = manoeuvre::footprint(prepare::default_car())};
}

TEST(SuiteSource, DrawsTheSameEncounterAgain) {
  const SuiteSource source = SuiteSource::open(draw_of("balanced")).value();
  const auto text = [](const SuiteSource& from) {
    return scenario::write_scenario(from.sample(3).value().scenario);
  };
  EXPECT_EQ(text(source), text(SuiteSource::open(draw_of("balanced")).value()));
  EXPECT_NE(text(source),
            text(SuiteSource::open(draw_of("balanced", families::Split::calibration)).value()));
  std::set<std::string> families;
  for (std::uint64_t number = 0; number < 100; ++number) {
    families.insert(source.family_of(number));
  }
  EXPECT_GT(families.size(), 1U);
}

TEST(SuiteSource, AFamilyIsASuiteOfItself) {
  const SuiteSource source = SuiteSource::open(draw_of("crossing")).value();
  EXPECT_EQ(source.family_of(0), "crossing");
  EXPECT_EQ(source.family_of(17), "crossing");
}

TEST(SuiteSource, RefusesWhatMayNotBeDrawn) {
  for (const char* const name : {"no_such", "", "surroundings", "../families/crossing"}) {
    const auto source = SuiteSource::open(draw_of(name));
    ASSERT_FALSE(source.has_value()) << name;
    EXPECT_THAT(source.error().message, HasSubstr("want one of natural, balanced")) << name;
  }
  EXPECT_THAT(SuiteSource::open(draw_of("balanced", families::Split::test)).error().message,
              HasSubstr("log"));
  SuiteDraw nowhere = draw_of("balanced");
  nowhere.scenarios = "nowhere";
  EXPECT_EQ(SuiteSource::open(nowhere).error().code, Error::Code::unreadable);
}

}  // namespace
}  // namespace saca::eval::suite_source_test
