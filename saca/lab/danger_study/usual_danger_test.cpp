#include "saca/lab/danger_study/usual_danger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::danger_study::usual_danger_test {
namespace {

using testing::HasSubstr;

TEST(UsualDanger, LiesWhereTheCarsOwnIs) {
  const auto here = installation::here_for_test();
  const auto inputs = installation::read_scenario_inputs(here, "one_way").value();
  const DangerSources sources = danger_sources(here, inputs);
  EXPECT_EQ(sources.weights, "./models/danger/compact_rwd_ev.safetensors");
  EXPECT_EQ(sources.tables.place("t"), here.cache / "reach/compact_rwd_ev/t.h5");
  EXPECT_TRUE(usual_danger(here, inputs).value().has_value());  // learnt of the shipped car
}

TEST(UsualDanger, WeightsAreReadWithTheirCar) {
  const auto here = installation::here_for_test();
  const auto weights = read_danger_weights(here, "models/danger/compact_rwd_ev.safetensors");
  ASSERT_TRUE(weights.has_value()) << weights.error().message;
  EXPECT_EQ(weights.value().inputs.car_name, "compact_rwd_ev");
  EXPECT_THAT(read_danger_weights(here, "models/none.safetensors").error().message,
              HasSubstr("models/none.safetensors"));
}

}  // namespace
}  // namespace saca::danger_study::usual_danger_test
