#include "saca/lab/vehicle_study/physics_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace saca::vehicle_study::physics_report_test {
namespace {

using nlohmann::json;

std::vector<verification::Figure> figures() {
  return {
      {.name = "physics.stop_m", .value = 16.5, .reference = 16.25, .low = 15.0, .high = 18.0},
      {.name = "physics.order", .value = 3.0, .reference = std::nullopt, .low = 3.5, .high = 5.0}};
}

TEST(PhysicsReport, EachFigureHasItsBandAndWhereThereIsOneItsReference) {
  EXPECT_EQ(json_of(figures()), json({{"physics.stop_m", 16.5},
                                      {"physics.stop_m.low", 15.0},
                                      {"physics.stop_m.high", 18.0},
                                      {"physics.stop_m.reference", 16.25},
                                      {"physics.order", 3.0},
                                      {"physics.order.low", 3.5},
                                      {"physics.order.high", 5.0},
                                      {"physics.outside_band", 1}}));
}

TEST(PhysicsReport, ALineForEach) {
  EXPECT_EQ(text_of(figures()),
            "physics.stop_m                                     16.5000   reference   16.250   "
            "band  15.000 to  18.000   inside\n"
            "physics.order                                       3.0000   reference        -   "
            "band   3.500 to   5.000   OUTSIDE\n"
            "outside their bands: 1\n");
  EXPECT_EQ(text_of(std::vector<verification::Figure>{}), "outside their bands: 0\n");
}

}  // namespace
}  // namespace saca::vehicle_study::physics_report_test
