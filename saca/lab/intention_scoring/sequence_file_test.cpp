#include "saca/lab/intention_scoring/sequence_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/checksummed_hdf5.h"
#include "saca/base/formats/hdf5_rows.h"
#include "saca/lab/intention_scoring/sequences_for_test.h"
#include "saca/lab/intention_scoring/simulated.h"

namespace saca::intention_scoring::sequence_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string path_of_test() {
  return testing::TempDir() + "sequence_file_test_" +
         testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
}

SequenceSet small_set() {
  SequenceSet set{.sequences = simulated_sequences(4, 5, 1),
                  .splits = {"train", "tune", "test", "train"}};
  Sequence recorded = labelled("MLB");
  recorded.name = "us101/1 a";
  recorded.site = "us101";
  recorded.group = "g";
  recorded.scored[1] = false;
  set.sequences.push_back(recorded);
  set.splits.emplace_back("test");
  return set;
}

/// Bit by bit: NaN equals NaN.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

void expect_same(const intent::Observation& a, const intent::Observation& b) {
  EXPECT_TRUE(same(a.speed, b.speed) && same(a.acceleration, b.acceleration) &&
              same(a.yaw_rate, b.yaw_rate) && same(a.offset, b.offset));
  EXPECT_TRUE(same(a.lateral_speed, b.lateral_speed) && same(a.heading, b.heading) &&
              same(a.lane_width, b.lane_width));
  EXPECT_TRUE(same(a.gap, b.gap) && same(a.gap_speed, b.gap_speed));
  EXPECT_TRUE(same(a.steering, b.steering) && same(a.throttle, b.throttle) &&
              same(a.brake, b.brake));
}

TEST(SequenceFile, GivesBackTheSameBits) {
  const SequenceSet set = small_set();
  ASSERT_FALSE(write_sequences(path_of_test(), set));
  const auto read = read_sequences(path_of_test());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const SequenceSet& back = read.value();
  EXPECT_EQ(back.splits, set.splits);
  ASSERT_EQ(back.sequences.size(), set.sequences.size());
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    const Sequence& a = set.sequences[i];
    const Sequence& b = back.sequences[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.site, b.site);
    EXPECT_EQ(a.group, b.group);
    EXPECT_EQ(a.simulated, b.simulated);
    EXPECT_EQ(a.labels, b.labels);
    EXPECT_EQ(a.scored, b.scored);
    EXPECT_EQ(a.crossing_times, b.crossing_times);
    EXPECT_EQ(a.braking_times, b.braking_times);
    ASSERT_EQ(a.observations.size(), b.observations.size());
    for (std::size_t t = 0; t < a.observations.size(); ++t) {
      expect_same(a.observations[t], b.observations[t]);
    }
  }
}

TEST(SequenceFile, SameSetSameBytes) {
  ASSERT_FALSE(write_sequences(path_of_test(), small_set()));
  const std::string once = read_file(path_of_test()).value();
  ASSERT_FALSE(write_sequences(path_of_test(), small_set()));
  EXPECT_EQ(once, read_file(path_of_test()).value());
}

TEST(SequenceFile, NeedsNoEvents) {
  SequenceSet set{{labelled("M")}, {"train"}};
  set.sequences[0].site = "a";
  ASSERT_FALSE(write_sequences(path_of_test(), set));
  const auto read = read_sequences(path_of_test());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_TRUE(read.value().sequences[0].crossing_times.empty());
}

TEST(SequenceFile, RefusesDamageAndOtherFiles) {
  ASSERT_FALSE(write_sequences(path_of_test(), small_set()));
  const std::string bytes = read_file(path_of_test()).value();
  ASSERT_FALSE(write_file(path_of_test(), bytes.substr(0, bytes.size() / 2)));
  EXPECT_THAT(read_sequences(path_of_test()).error().message, HasSubstr("cut off or damaged"));
  ASSERT_FALSE(write_file(path_of_test(), ""));
  EXPECT_THAT(read_sequences(path_of_test()).error().message, HasSubstr("an empty file"));
  EXPECT_EQ(read_sequences(path_of_test() + ".none").error().code, Error::Code::unreadable);
}

/// A file of two sequences with three frames in all.
void write_by_hand(const std::function<bool(const std::string& name)>& leaves_out,
                   const std::vector<double>& num_frames, double label) {
  formats::Hdf5Writer writer;
  writer.group("sequences");
  writer.group("frames");
  const std::vector<std::string> words{"a", "b"};
  for (const char* name :
       {"sequences/names", "sequences/sites", "sequences/groups", "sequences/splits"}) {
    if (!leaves_out(name)) {
      formats::write_lines(writer, name, words);
    }
  }
  formats::write_row(writer, "sequences/simulated", {0.0, 1.0});
  formats::write_row(writer, "sequences/num_frames", num_frames);
  formats::write_row(writer, "sequences/num_crossings", {0.0, 0.0});
  formats::write_row(writer, "sequences/num_brakings", {0.0, 0.0});
  for (const char* name :
       {"frames/speed_mps", "frames/acceleration_mps2", "frames/yaw_rate_radps", "frames/offset_m",
        "frames/lateral_speed_mps", "frames/heading_rad", "frames/lane_width_m", "frames/gap_m",
        "frames/gap_speed_mps", "frames/steering_rad", "frames/throttle", "frames/brake",
        "frames/scored"}) {
    if (!leaves_out(name)) {
      formats::write_row(writer, name, {1.0, 1.0, 1.0});
    }
  }
  formats::write_row(writer, "frames/label", {0.0, 1.0, label});
  EXPECT_FALSE(formats::write_sealed_hdf5(path_of_test(), "saca.sequences/1", writer));
}

std::string refusal_with(const std::function<bool(const std::string& name)>& leaves_out,
                         const std::vector<double>& num_frames, double label) {
  write_by_hand(leaves_out, num_frames, label);
  const auto read = read_sequences(path_of_test());
  return read.has_value() ? "" : read.error().message.substr(path_of_test().size());
}

TEST(SequenceFile, RefusesWhatDoesNotAddUp) {
  const auto nothing = [](const std::string& /*name*/) { return false; };
  EXPECT_EQ(refusal_with(nothing, {1.0, 2.0}, 5.0), "");
  EXPECT_EQ(refusal_with(nothing, {1.0, 1.0}, 5.0),
            ": data set sequences/num_frames: want counts of 3 together, got 2");
  EXPECT_EQ(refusal_with(nothing, {0.0, 3.0}, 5.0),
            ": data set sequences/num_frames: want whole numbers from 1 on, got 0");
  EXPECT_EQ(refusal_with(nothing, {1.0, 2.0}, 6.0), ": contents: b: labels are 0 to 5");
  EXPECT_THAT(refusal_with(nothing, {1.0, 2.0}, 256.0), HasSubstr("labels are 0 to 5"));
  EXPECT_EQ(refusal_with(nothing, {1.0, 2.0}, 0.5),
            ": data set frames/label: want whole numbers from 0 on, got 0.5");
  EXPECT_THAT(
      refusal_with([](const std::string& name) { return name == "frames/gap_m"; }, {1.0, 2.0}, 5.0),
      HasSubstr("frames/gap_m"));
  EXPECT_THAT(refusal_with([](const std::string& name) { return name == "sequences/splits"; },
                           {1.0, 2.0}, 5.0),
              HasSubstr("sequences/splits"));
}

TEST(SequenceSet, KnowsItsRules) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto broken = [](const std::function<void(SequenceSet&)>& change) {
    SequenceSet set = small_set();
    change(set);
    return broken_rule(set).value_or("");
  };
  EXPECT_EQ(broken([](SequenceSet& /*set*/) {}), "");
  EXPECT_THAT(broken([](SequenceSet& set) { set.splits.pop_back(); }), HasSubstr("split"));
  EXPECT_THAT(broken([](SequenceSet& set) { set.splits[0] = ""; }), HasSubstr("split"));
  EXPECT_THAT(broken([](SequenceSet& set) { set.sequences[0].name = set.sequences[1].name; }),
              HasSubstr("unique"));
  EXPECT_THAT(broken([](SequenceSet& set) { set.sequences[0].site = "a\nb"; }),
              HasSubstr("one line"));
  EXPECT_THAT(broken([](SequenceSet& set) { set.sequences[0].labels.pop_back(); }),
              HasSubstr("a label"));
  EXPECT_THAT(broken([](SequenceSet& set) { set.sequences[0].observations[3].speed = -1.0; }),
              HasSubstr("speeds"));
  EXPECT_THAT(
      broken([](SequenceSet& set) { set.sequences[0].observations[3].speed = std::nan(""); }),
      HasSubstr("speeds"));
  EXPECT_THAT(broken([=](SequenceSet& set) { set.sequences[0].observations[3].offset = infinity; }),
              HasSubstr("only a gap"));
  EXPECT_THAT(broken([=](SequenceSet& set) { set.sequences[0].observations[3].gap = -infinity; }),
              HasSubstr("only a gap"));
  EXPECT_EQ(broken([=](SequenceSet& set) { set.sequences[0].observations[3].gap = infinity; }), "");
  EXPECT_THAT(broken([](SequenceSet& set) {
                set.sequences[0].braking_times = {2.0, 2.0};
              }),
              HasSubstr("increase"));
  EXPECT_THROW((void)write_sequences(path_of_test(), {}), ContractViolation);
  SequenceSet wrong = small_set();
  wrong.splits.clear();
  EXPECT_THROW((void)write_sequences(path_of_test(), wrong), ContractViolation);
}

}  // namespace
}  // namespace saca::intention_scoring::sequence_file_test
