#include "saca/lab/intention_scoring/forecast_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "saca/base/core/contract.h"
#include "saca/base/formats/checksummed_hdf5.h"
#include "saca/base/formats/hdf5_rows.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"

namespace saca::intention_scoring::forecast_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string path_of_test() {
  return testing::TempDir() + "forecast_file_test_" +
         testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
}

ForecastSet small_set() {
  ForecastSet set{.model = "by hand, two lines\nof it",
                  .names = {"a", "b"},
                  .forecasts = {all_heads("MLB"), all_heads("rM", 0.4)}};
  set.forecasts[0].at[2] = predicted("lll", 1.0);
  return set;
}

TEST(ForecastFile, GivesBackTheSameBits) {
  const ForecastSet set = small_set();
  ASSERT_FALSE(write_forecasts(path_of_test(), set));
  const auto read = read_forecasts(path_of_test());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value().model, set.model);
  EXPECT_EQ(read.value().names, set.names);
  ASSERT_EQ(read.value().forecasts.size(), 2U);
  EXPECT_EQ(read.value().forecasts[0].at, set.forecasts[0].at);
  EXPECT_EQ(read.value().forecasts[1].at, set.forecasts[1].at);
}

void write_by_hand(const std::vector<double>& num_frames, const std::vector<double>& numbers,
                   const std::vector<std::size_t>& extents, const std::vector<std::string>& names) {
  formats::Hdf5Writer writer;
  writer.text("model", "m");
  formats::write_lines(writer, "names", names);
  formats::write_row(writer, "num_frames", num_frames);
  writer.numbers<double>("probabilities", extents, {numbers.data()});
  EXPECT_FALSE(formats::write_sealed_hdf5(path_of_test(), "saca.forecasts/1", writer));
}

std::string refusal(const std::vector<double>& num_frames, const std::vector<double>& numbers,
                    const std::vector<std::size_t>& extents,
                    const std::vector<std::string>& names) {
  write_by_hand(num_frames, numbers, extents, names);
  const auto read = read_forecasts(path_of_test());
  return read.has_value() ? "" : read.error().message.substr(path_of_test().size());
}

TEST(ForecastFile, RefusesWhatIsNoForecast) {
  std::vector<double> numbers(36, 1.0 / 6.0);
  EXPECT_EQ(refusal({2.0}, numbers, {3, 2, 6}, {"a"}), "");
  EXPECT_EQ(refusal({1.0, 1.0}, numbers, {3, 2, 6}, {"a", "b"}), "");
  EXPECT_EQ(refusal({3.0}, numbers, {3, 2, 6}, {"a"}),
            ": data set num_frames: want counts of 2 together, got 3");
  EXPECT_THAT(refusal({3.0}, numbers, {2, 3, 6}, {"a"}), HasSubstr("want 3 x 3 x 6 numbers"));
  EXPECT_THAT(refusal({2.0}, numbers, {3, 12}, {"a"}), HasSubstr("num_frames"));
  EXPECT_THAT(refusal({2.0}, numbers, {3, 2, 6}, {"a", "b"}), HasSubstr("want 1 lines"));
  EXPECT_EQ(refusal({1.0, 1.0}, numbers, {3, 2, 6}, {"a", "a"}),
            ": data set names: want each once, got a twice");
  numbers[20] = 0.5;
  EXPECT_EQ(refusal({1.0, 1.0}, numbers, {3, 2, 6}, {"a", "b"}),
            ": data set probabilities: want numbers in [0, 1] that sum to 1, got others in b");
  numbers[20] = 1.0 / 3.0;
  numbers[21] = -0.0;
  EXPECT_EQ(refusal({1.0, 1.0}, numbers, {3, 2, 6}, {"a", "b"}), "");
  numbers[21] = -1e-3;
  EXPECT_THAT(refusal({1.0, 1.0}, numbers, {3, 2, 6}, {"a", "b"}), HasSubstr("in [0, 1]"));
}

TEST(ForecastFile, RefusesToWriteWhatDoesNotFit) {
  EXPECT_THROW((void)write_forecasts(path_of_test(), {}), ContractViolation);
  ForecastSet set = small_set();
  set.names.pop_back();
  EXPECT_THROW((void)write_forecasts(path_of_test(), set), ContractViolation);
  set = small_set();
  set.forecasts[0].at[1].pop_back();
  EXPECT_THROW((void)write_forecasts(path_of_test(), set), ContractViolation);
  set = small_set();
  set.forecasts[0].at[1][0][0] = 0.5;
  EXPECT_THROW((void)write_forecasts(path_of_test(), set), ContractViolation);
}

TEST(ForecastsOf, AreFoundByName) {
  std::vector<Sequence> wanted{labelled("MM"), labelled("MMM")};
  wanted[0].name = "b";
  wanted[1].name = "a";
  const auto found = forecasts_of(small_set(), wanted, "f.h5");
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found.value()[0].at, small_set().forecasts[1].at);
  EXPECT_EQ(found.value()[1].at, small_set().forecasts[0].at);
  wanted[0].name = "c";
  EXPECT_EQ(forecasts_of(small_set(), wanted, "f.h5").error().message,
            "f.h5: want forecasts of c, got none");
  wanted[0].name = "a";
  EXPECT_EQ(forecasts_of(small_set(), wanted, "f.h5").error().message,
            "f.h5: a: want 2 frames, got 3");
}

}  // namespace
}  // namespace saca::intention_scoring::forecast_file_test
