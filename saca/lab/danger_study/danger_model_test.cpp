#include "saca/lab/danger_study/danger_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "saca/base/core/file.h"
#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::danger_study::danger_model_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DangerModels : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(testing::TempDir()) / "danger_model" /
                           testing::UnitTest::GetInstance()->current_test_info()->name();
  std::vector<std::string> noticed_;
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] DangerSources sources() {
    return {.car = {"compact", prepare::default_car()},
            .weights = folder_ / "compact.safetensors",
            .tables = {.place = [this](const std::string& table) { return folder_ / table; },
                       .notice = [this](const std::string& what) { noticed_.push_back(what); },
                       .display = long_work::ProgressDisplay::silent}};
  }
  void write(std::map<std::string, std::string> words) {
    ASSERT_EQ(write_file(sources().weights, formats::tensor_bytes(blind_networks(words))),
              std::nullopt);
  }
  /// Words of the car as it is, and a margin of 0.5 m everywhere.
  [[nodiscard]] static std::map<std::string, std::string> right_words() {
    std::map<std::string, std::string> words{
        {"car", "compact"}, {"vehicle", learned_danger::vehicle_word(prepare::default_car())}};
    std::array<double, learned_danger::num_bins> metres{};
    metres.fill(0.5);
    learned_danger::Margins(metres).add_to(words);
    return words;
  }
  /// A standing car, 6 m before the ego's front at 10 m/s.
  [[nodiscard]] static danger::Meeting ahead() {
    const world::Footprint body = manoeuvre::footprint(prepare::default_car());
    const double distance = body.centre_x + 0.5 * body.length + 6.0 + 2.25;
    return {.ego = body,
            .obstacle = {.length = 4.5, .width = 1.8},
            .grip = 0.9,
            .state = {-distance, 0.0, 0.0, 10.0}};
  }
  /// Nobody is there, who would need a table.
  [[nodiscard]] static scenario::Scenario empty_road() {
    scenario::Scenario scenario;
    scenario.duration = 1.0;
    scenario.ego = scenario::EgoStart{.pose = {}, .speed = 10.0};
    return scenario;
  }
};

TEST_F(DangerModels, AreByWhatWasLearnt) {
  write(right_words());
  const auto model = usual_model(sources(), empty_road(), TableUse::none);
  ASSERT_TRUE(model.has_value()) << model.error().message;
  ASSERT_TRUE(model.value().has_value());
  // Blind networks tell h + log 2; the margin is added.
  EXPECT_NEAR(model.value()->known(ahead()).value(), -6.0 + std::log(2.0) + 0.5, 1e-4);
  EXPECT_THAT(noticed_, IsEmpty());
}

TEST_F(DangerModels, AreNoneWhereNothingWasLearntAndNoTablesAreWanted) {
  EXPECT_EQ(usual_model(sources(), empty_road(), TableUse::none).value().has_value(), false);
  const auto by_tables = usual_model(sources(), empty_road(), TableUse::solved);
  ASSERT_TRUE(by_tables.value().has_value());
  EXPECT_EQ(by_tables.value()->known(ahead()), std::nullopt);
}

TEST_F(DangerModels, DoNotUseWhatWasLearntOfAnotherCar) {
  auto words = right_words();
  words["vehicle"] = "another";
  write(words);
  EXPECT_FALSE(usual_model(sources(), empty_road(), TableUse::none).value().has_value());
  EXPECT_THAT(noticed_, ElementsAre(HasSubstr("learnt of another compact than that of today")));
}

TEST_F(DangerModels, WantMargins) {
  write({{"car", "compact"}, {"vehicle", right_words().at("vehicle")}});
  const auto refused = usual_model(sources(), empty_road(), TableUse::none);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message,
            sources().weights.string() + ": want margins (`saca danger margins`), got none");
  ASSERT_EQ(write_file(sources().weights, "no weights"), std::nullopt);
  EXPECT_THAT(learned_value_of(sources()).error().message, HasSubstr(sources().weights.string()));
}

TEST_F(DangerModels, OfDataSetsMayHaveNoTables) {
  const auto model = model_of_drawn(sources(), TableUse::none);
  ASSERT_TRUE(model.has_value());
  EXPECT_EQ(model.value().exact(ahead()), std::nullopt);
  EXPECT_FALSE(model.value().danger(ahead()).exact);
}

TEST_F(DangerModels, HaveTheTablesThatAreAskedFor) {
  danger::DangerCase wanted =
      reach_study::tables_for(sources().car, 0.9, {{ahead().obstacle, 0.0}}).value().at(0);
  for (danger::Axis& axis : wanted.asked.grid.axes) {
    axis.points = (axis.points + 1) / 2;
  }
  wanted.asked.times = {0.2};
  const auto model = model_by_tables(sources(), {wanted});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_TRUE(model.value().exact(ahead()).has_value());
  EXPECT_TRUE(fs::exists(folder_ / wanted.name));
}

}  // namespace
}  // namespace saca::danger_study::danger_model_test
