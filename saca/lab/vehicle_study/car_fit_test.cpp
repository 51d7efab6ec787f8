#include "saca/lab/vehicle_study/car_fit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/lab/tune/fit_drive.h"

namespace saca::vehicle_study::car_fit_test {
namespace {

using testing::HasSubstr;

constexpr const char* base_file = "data/vehicles/compact_rwd_ev.toml";

tune::Log driven(const std::string& name) {
  tune::Log log =
      tune::drive_test(prepare::default_vehicle(), {.kind = tune::TestKind::brake, .noise = 0.1});
  log.name = name;
  return log;
}

TEST(CarFit, TheFileIsReadByTheFittedCarAndNamesTheLogsAlone) {
  const BaseCar base = read_base(base_file).value();
  EXPECT_EQ(base.file, base_file);
  const FittedCar fitted =
      fit_car(base, 0.9, {driven("far/away/one.csv"), driven("two.csv")}).value();
  EXPECT_EQ(fitted.fit.parameters.front().key, "grip");
  EXPECT_NEAR(fitted.fit.parameters.front().value, 0.9, 0.02) << "the grip that was driven on";
  ASSERT_TRUE(std::any_of(fitted.fit.parameters.begin() + 1, fitted.fit.parameters.end(),
                          [](const auto& one) { return one.determined; }));
  EXPECT_THAT(fitted.file, HasSubstr("fitted to one.csv, two.csv:"));
  EXPECT_THAT(fitted.file, testing::Not(HasSubstr("far/away")));
}

TEST(CarFit, LogsAreReadInTheirOrder) {
  const vehicle::Vehicle car = prepare::default_vehicle();
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "car_fit_log.csv";
  const tune::Log driven = tune::drive_test(car, tune::TestDrive{});
  ASSERT_EQ(write_file(file, tune::write_log(driven)), std::nullopt);
  const auto logs = read_logs({file.string(), file.string()}, car);
  ASSERT_TRUE(logs.has_value()) << logs.error().message;
  ASSERT_EQ(logs.value().size(), 2U);
  EXPECT_EQ(logs.value()[1].time, tune::read_log(tune::write_log(driven), "", car).value().time);
  EXPECT_EQ(read_logs({file.string(), "no_such.csv"}, car).error().code, Error::Code::unreadable);
  std::filesystem::remove(file);
}

TEST(CarFit, ABaseThatCannotBeReadIsNamed) {
  EXPECT_EQ(read_base("no_such.toml").error().code, Error::Code::unreadable);
  const auto problem = read_base("data/harm.toml");
  ASSERT_FALSE(problem.has_value());
  EXPECT_THAT(problem.error().message, HasSubstr("data/harm.toml"));
}

}  // namespace
}  // namespace saca::vehicle_study::car_fit_test
