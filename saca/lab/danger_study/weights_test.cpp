#include "saca/lab/danger_study/weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/file.h"
#include "saca/lab/danger_study/weights_for_test.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::danger_study::weights_test {
namespace {

using testing::HasSubstr;

class WeightsFile : public testing::Test {
 protected:
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".weights");
  void TearDown() override { std::filesystem::remove(path_); }

  void write(const std::map<std::string, std::string>& words) {
    ASSERT_EQ(write_file(path_, formats::tensor_bytes(blind_networks(words))), std::nullopt);
  }
};

TEST_F(WeightsFile, TellsOfWhichCarItIs) {
  write({{"car", "some_car"}, {"seed", "3"}});
  const auto weights = read_weights(path_);
  ASSERT_TRUE(weights.has_value()) << weights.error().message;
  EXPECT_EQ(weights.value().car_name, "some_car");
  EXPECT_EQ(weights.value().tensors.words.at("seed"), "3");
  EXPECT_EQ(weights.value().network.digest(), blind_network().digest());
}

TEST_F(WeightsFile, OfAPointMassHasNoCar) {
  write({});
  EXPECT_TRUE(read_network(path_).has_value());
  const auto refused = read_weights(path_);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message, path_.string() + ": want a word `car`, got none");
}

TEST_F(WeightsFile, ThatIsNoneIsNamed) {
  EXPECT_THAT(read_network(path_).error().message, HasSubstr(path_.string()));
  ASSERT_EQ(write_file(path_, "nothing of the kind"), std::nullopt);
  EXPECT_THAT(read_weights(path_).error().message, HasSubstr(path_.string()));
}

TEST_F(WeightsFile, IsRefusedWhereTheCarIsAnotherThanItWas) {
  const manoeuvre::Car car = prepare::default_car();
  const auto why = [&](const std::map<std::string, std::string>& words) {
    write(words);
    return why_of_another_car(read_weights(path_).value(), car, "w");
  };
  const std::string own = learned_danger::vehicle_word(car);
  EXPECT_EQ(why({{"car", "a"}}), std::nullopt);  // it does not say
  EXPECT_EQ(why({{"car", "a"}, {"vehicle", own}}), std::nullopt);
  EXPECT_EQ(why({{"car", "a"}, {"vehicle", "0"}}).value().message,
            "w: want weights of the car a as its file is now (" + own +
                "), got 0: its numbers were changed, and V_h is to be learnt anew");
}

}  // namespace
}  // namespace saca::danger_study::weights_test
