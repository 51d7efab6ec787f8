#include "saca/lab/benchmarks/atlas_times.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "saca/lab/benchmarks/counted_clock_for_test.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::benchmarks::atlas_times_test {
namespace {

TEST(AtlasTimes, EveryFigureIsThereForEachCrowdAndEachQuestion) {
  const CountedClock clock;
  const nlohmann::json figures =
      atlas_times(atlas::small_atlas_car(), atlas::small_atlas(),
                  prepare::read_harm("data/harm.toml").value(), clock, 2);
  EXPECT_EQ(figures.size(), 4U * 3U * 2U * 2U);
  for (const std::string suffix :
       {".actors1", ".actors8.targets4", ".actors32.spread", ".actors32.spread.targets4"}) {
    EXPECT_NEAR(figures.at("atlas.futures_us.p50" + suffix).get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(figures.at("atlas.futures_us.p99" + suffix).get<double>(), 1.0, 1e-9);
    EXPECT_EQ(figures.at("atlas.futures_us.n" + suffix), 2);
    EXPECT_EQ(figures.at("atlas.outside_share" + suffix), 1.0)
        << "20 m/s is faster than anything in this atlas";
  }
}

}  // namespace
}  // namespace saca::benchmarks::atlas_times_test
