#include "saca/lab/vehicle_study/car_tuning.h"

#include <gmock/gmock.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/trials.h"

namespace saca::vehicle_study::car_tuning_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* car_file = "data/vehicles/compact_rwd_ev.toml";

TuningWork work(const std::string& program) {
  return {.program = program,
          .car = "a_car",
          .swerve_evaluations = 2,
          .drift_evaluations = 2,
          .output = fs::path(testing::TempDir()) / "car_tuning.toml",
          .display = long_work::ProgressDisplay::silent};
}

TEST(CarTuning, CostsAreThoseOfTheCarThatComesOutAndJournalsStandUntilTheyAreRemoved) {
  manoeuvre::Car car = prepare::default_car();
  const manoeuvre::DriftDomain domain = car.tuning.domain;
  const LawCosts costs = tune_laws(work("a program"), car).value().value();
  EXPECT_EQ(costs.swerve, tune::total_cost(car, tune::swerve_trials(1), tune::swerve_cost, 1));
  EXPECT_EQ(costs.drift, tune::total_cost(car, tune::drift_trials(1), tune::drift_cost, 1));
  EXPECT_EQ(car.tuning.domain.slowest, domain.slowest) << "the domain is found apart";
  const fs::path swerve = work("").output.string() + ".swerve.journal";
  const fs::path drift = work("").output.string() + ".drift.journal";
  EXPECT_TRUE(fs::exists(swerve) && fs::exists(drift));
  manoeuvre::Car other = prepare::default_car();
  const auto refused = tune_laws(work("another program"), other);
  ASSERT_FALSE(refused.has_value()) << "the journals are not of this program";
  EXPECT_THAT(refused.error().message, testing::HasSubstr("another program: lane change of a_car"));
  remove_journals(work(""));
  EXPECT_FALSE(fs::exists(swerve) || fs::exists(drift));
}

TEST(CarTuning, TheDomainIsThatOfTheTunedLaws) {
  const TuningWork task = work("a program");
  manoeuvre::Car car = prepare::default_car();
  ASSERT_TRUE(tune_car(task, 2, car).value().has_value());
  manoeuvre::Car laws = prepare::default_car();
  ASSERT_TRUE(tune_laws(task, laws).value().has_value());
  const auto domain = tune::find_domain(laws, 2, task.seed + 1, 1, [] { return true; });
  ASSERT_TRUE(domain.has_value());
  EXPECT_EQ(car.tuning.domain.slowest, domain->slowest);
  EXPECT_EQ(car.tuning.domain.fastest, domain->fastest);
  remove_journals(task);
}

TEST(CarTuning, BeginsWithTheTuningThatIsNamed) {
  const manoeuvre::Car car = read_start(car_file, "data/vehicles/delivery_van.tuning.toml").value();
  EXPECT_EQ(car.mass, prepare::default_car().mass);
  EXPECT_EQ(car.tuning.swerve.share, prepare::shipped_car("delivery_van").tuning.swerve.share);
  EXPECT_EQ(read_start("no_such.toml", "x").error().code, Error::Code::unreadable);
  EXPECT_EQ(read_start(car_file, "no_such.toml").error().code, Error::Code::unreadable);
}

}  // namespace
}  // namespace saca::vehicle_study::car_tuning_test
