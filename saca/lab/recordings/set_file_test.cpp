#include "saca/lab/recordings/set_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/checksummed_file.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::recordings::set_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Numbers are such that 32 bits hold them exactly.
RecordedSet small_set() {
  RecordedSet set;
  for (const int r : {0, 1}) {
    Recording recording{
        "file " + std::to_string(r) + ".xml", "here", "here-" + std::to_string(r), 0.1, {}};
    for (const int v : {0, 1, 2}) {
      RecordedVehicle vehicle{.id = 100 * r + v - 1,
                              .type = v == 0 ? "" : "truck",
                              .length = v == 1 ? not_known : 4.123,
                              .width = 1.8,
                              .start = 0.3 * v};
      for (int k = 0; k <= v; ++k) {
        Sample sample;
        if (v != 1) {
          sample.X_WA = {{1e6 + 0.1 * k, -4e6 / 3.0}, 0.125 * k};
        }
        sample.speed = 10.0 - 0.5 * k;
        sample.offset = 0.25 * v;
        sample.lane_step = v == 2 ? 1 - k : 0;
        sample.left_lane = v == 1;
        sample.right_lane = v == 2;
        sample.gap = v == 1 ? std::numeric_limits<double>::infinity() : 7.5;
        sample.lead_speed = v == 1 ? not_known : 3.5;
        sample.brake_pedal = v == 0 ? not_known : 0.5;
        sample.measured_yaw_rate = -0.0625;
        vehicle.samples.push_back(sample);
      }
      recording.vehicles.push_back(vehicle);
    }
    set.recordings.push_back(recording);
  }
  set.skipped = {{"file: broken", 3}, {"vehicle: short", 12}};
  return set;
}

void expect_same(double a, double b) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " and " << b;
}
void expect_same(const Sample& a, const Sample& b) {
  expect_same(a.X_WA.p.x, b.X_WA.p.x);
  expect_same(a.X_WA.p.y, b.X_WA.p.y);
  expect_same(a.X_WA.yaw, b.X_WA.yaw);
  expect_same(a.speed, b.speed);
  expect_same(a.offset, b.offset);
  expect_same(a.heading, b.heading);
  expect_same(a.lane_width, b.lane_width);
  expect_same(a.curvature, b.curvature);
  EXPECT_EQ(a.lane_step, b.lane_step);
  EXPECT_EQ(a.left_lane, b.left_lane);
  EXPECT_EQ(a.right_lane, b.right_lane);
  expect_same(a.gap, b.gap);
  expect_same(a.lead_speed, b.lead_speed);
  expect_same(a.brake_pedal, b.brake_pedal);
  expect_same(a.steering, b.steering);
  expect_same(a.throttle, b.throttle);
  expect_same(a.measured_acceleration, b.measured_acceleration);
  expect_same(a.measured_yaw_rate, b.measured_yaw_rate);
}

class SetFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(::testing::TempDir()) / (std::string("set_") + test->name() + ".h5");
  }
  void TearDown() override { fs::remove(path_); }

  [[nodiscard]] std::string refusal() const {
    const auto set = read_set(path_);
    return set.has_value() ? "" : set.error().message;
  }
  /// What a small set's file is, but for one part.
  void write_but(const std::string& part, const std::function<void(formats::Hdf5Writer&)>& other);

  fs::path path_;
};

TEST_F(SetFile, ReadsBackWhatWasWritten) {
  const RecordedSet set = small_set();
  ASSERT_EQ(write_set(path_, set), std::nullopt);
  const auto read = read_set(path_);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value().skipped, set.skipped);
  ASSERT_EQ(read.value().recordings.size(), 2U);
  for (std::size_t r = 0; r < 2; ++r) {
    const Recording& a = set.recordings[r];
    const Recording& b = read.value().recordings[r];
    EXPECT_EQ(std::tie(a.name, a.site, a.group, a.step), std::tie(b.name, b.site, b.group, b.step));
    ASSERT_EQ(b.vehicles.size(), 3U);
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_EQ(a.vehicles[v].id, b.vehicles[v].id);
      EXPECT_EQ(a.vehicles[v].type, b.vehicles[v].type);
      expect_same(a.vehicles[v].length, b.vehicles[v].length);
      expect_same(a.vehicles[v].width, b.vehicles[v].width);
      expect_same(a.vehicles[v].start, b.vehicles[v].start);
      ASSERT_EQ(a.vehicles[v].samples.size(), b.vehicles[v].samples.size());
      for (std::size_t k = 0; k < a.vehicles[v].samples.size(); ++k) {
        expect_same(a.vehicles[v].samples[k], b.vehicles[v].samples[k]);
      }
    }
  }
}

TEST_F(SetFile, KeepsOtherNumbersIn32Bits) {
  RecordedSet set = small_set();
  set.recordings[0].vehicles[0].samples[0].speed = 10.1;
  ASSERT_EQ(write_set(path_, set), std::nullopt);
  const auto read = read_set(path_);
  ASSERT_TRUE(read.has_value());
  // Half a unit of the 24th bit.
  EXPECT_NEAR(read.value().recordings[0].vehicles[0].samples[0].speed, 10.1, 10.1 * 0x1p-24);
}

TEST_F(SetFile, MakesTheSameBytesOfTheSameSet) {
  ASSERT_EQ(write_set(path_, small_set()), std::nullopt);
  const std::string first = read_file(path_).value();
  ASSERT_EQ(write_set(path_, small_set()), std::nullopt);
  EXPECT_EQ(read_file(path_).value(), first);
}

TEST_F(SetFile, RefusesASetThatBreaksARule) {
  EXPECT_THROW((void)write_set(path_, {}), ContractViolation);
}

TEST_F(SetFile, TellsDamageAndOtherFiles) {
  EXPECT_THAT(refusal(), HasSubstr(path_.string()));
  ASSERT_EQ(write_set(path_, small_set()), std::nullopt);
  const std::string whole = read_file(path_).value();
  ASSERT_EQ(write_file(path_, whole.substr(0, whole.size() / 2)), std::nullopt);
  EXPECT_THAT(refusal(), HasSubstr("cut off or damaged"));
  ASSERT_EQ(formats::write_checksummed(path_, "saca.traffic/9", "body"), std::nullopt);
  EXPECT_THAT(refusal(), HasSubstr("want a file of saca.traffic/1, got saca.traffic/9"));
  ASSERT_EQ(formats::write_checksummed(path_, "saca.traffic/1", "no HDF5"), std::nullopt);
  EXPECT_THAT(refusal(), HasSubstr("want HDF5"));
}

// A sound file by other means, in which one part is as a test wants it: what the seal cannot see.
void SetFile::write_but(const std::string& part,
                        const std::function<void(formats::Hdf5Writer&)>& other) {
  formats::Hdf5Writer writer;
  const auto put = [&](const std::string& name, const std::function<void()>& usual) {
    name == part ? other(writer) : usual();
  };
  const auto column = [&](const char* name, std::vector<double> values) {
    put(name, [&] { writer.numbers<double>(name, {values.size()}, {values.data()}); });
  };
  const auto lines = [&](const char* name, const char* text) {
    put(name, [&] { writer.text(name, text); });
  };
  put("format", [&] { writer.attribute(".", "format", std::string("saca.traffic/1")); });
  for (const char* group : {"recordings", "vehicles", "samples", "skipped"}) {
    writer.group(group);
  }
  lines("recordings/names", "a\n");
  lines("recordings/sites", "b\n");
  lines("recordings/groups", "c\n");
  column("recordings/step_s", {0.1});
  column("recordings/num_vehicles", {1.0});
  column("vehicles/id", {5.0});
  lines("vehicles/types", "car\n");
  for (const char* name : {"vehicles/length_m", "vehicles/width_m", "vehicles/start_s"}) {
    column(name, {2.0});
  }
  column("vehicles/num_samples", {2.0});
  column("samples/x_m", {0.0, 1.0});
  column("samples/y_m", {0.0, 1.0});
  for (const char* name :
       {"yaw_rad", "speed_mps", "offset_m", "lane_heading_rad", "lane_width_m", "curvature_1pm",
        "lane_step", "left_lane", "right_lane", "gap_m", "lead_speed_mps", "brake_pedal",
        "steering_rad", "throttle", "measured_acceleration_mps2", "measured_yaw_rate_radps"}) {
    const std::string path = std::string("samples/") + name;
    const std::vector<float> ones{1.0F, 1.0F};
    put(path, [&] { writer.numbers<float>(path.c_str(), {2}, {ones.data()}); });
  }
  lines("skipped/reasons", "why\n");
  column("skipped/counts", {4.0});
  ASSERT_EQ(formats::write_checksummed(path_, "saca.traffic/1", writer.bytes().value()),
            std::nullopt);
}

TEST_F(SetFile, TakesAFileThatAnotherProgramWrote) {
  write_but("nothing", {});
  EXPECT_EQ(refusal(), "");
}

TEST_F(SetFile, ChecksEachPart) {
  const auto numbers = [](const char* name, std::vector<double> values) {
    return [name, values](formats::Hdf5Writer& writer) {
      writer.numbers<double>(name, {values.size()}, {values.data()});
    };
  };
  const auto floats = [](const char* name, std::vector<float> values) {
    return [name, values](formats::Hdf5Writer& writer) {
      writer.numbers<float>(name, {values.size()}, {values.data()});
    };
  };
  const double nan = not_known;
  const std::vector<std::pair<const char*, std::function<void(formats::Hdf5Writer&)>>> parts{
      {"format", [](auto& w) { w.attribute(".", "format", std::string("saca.traffic/2")); }},
      {"format", [](auto&) {}},
      {"recordings/names", [](auto& w) { w.text("recordings/names", "a\nb\n"); }},
      {"recordings/names", [](auto& w) { w.text("recordings/names", "\n"); }},
      {"recordings/sites", [](auto&) {}},
      {"recordings/step_s", numbers("recordings/step_s", {nan})},
      {"recordings/step_s", numbers("recordings/step_s", {-0.1})},
      {"recordings/step_s", numbers("recordings/step_s", {0.1, 0.1})},
      {"recordings/num_vehicles", numbers("recordings/num_vehicles", {2.0})},
      {"recordings/num_vehicles", numbers("recordings/num_vehicles", {0.5})},
      {"recordings/num_vehicles", numbers("recordings/num_vehicles", {1e300})},
      {"vehicles/id", numbers("vehicles/id", {0.5})},
      {"vehicles/types", [](auto& w) { w.text("vehicles/types", ""); }},
      {"vehicles/length_m", numbers("vehicles/length_m", {0.0})},
      {"vehicles/start_s", numbers("vehicles/start_s", {nan})},
      {"vehicles/num_samples", numbers("vehicles/num_samples", {3.0})},
      {"vehicles/num_samples", numbers("vehicles/num_samples", {1.0})},
      {"vehicles/num_samples", numbers("vehicles/num_samples", {-1.0})},
      {"samples/x_m", numbers("samples/x_m", {0.0, 1.0, 2.0})},
      {"samples/y_m", numbers("samples/y_m", {0.0, nan})},
      {"samples/speed_mps", floats("samples/speed_mps", {1.0F, NAN})},
      {"samples/speed_mps", floats("samples/speed_mps", {1.0F})},
      {"samples/speed_mps", numbers("samples/speed_mps", {1.0, 1.0})},
      {"samples/lane_step", floats("samples/lane_step", {1.0F, 3.0F})},
      {"samples/lane_step", floats("samples/lane_step", {1.0F, NAN})},
      {"samples/gap_m", floats("samples/gap_m", {1.0F, INFINITY})},  // a lead's speed is there
      {"samples/brake_pedal", floats("samples/brake_pedal", {1.0F, 2.0F})},
      {"samples/throttle", [](auto&) {}},
      {"skipped/counts", numbers("skipped/counts", {0.0})},
      {"skipped/reasons", [](auto& w) { w.text("skipped/reasons", "one\ntwo\n"); }},
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    write_but(parts[k].first, parts[k].second);
    EXPECT_THAT(refusal(), HasSubstr(path_.string() + ": ")) << k << ' ' << parts[k].first;
  }
}

}  // namespace
}  // namespace saca::recordings::set_file_test
