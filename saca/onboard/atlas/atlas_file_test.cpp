#include "saca/onboard/atlas/atlas_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/onboard/atlas/atlas_for_test.h"

namespace saca::atlas::atlas_file_test {
namespace {

class AtlasFile : public testing::Test {
 protected:
  static const std::string& good() {
    static const std::string bytes = atlas_bytes(small_atlas_car(), small_grid(), small_nodes());
    return bytes;
  }
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            (std::string("saca_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
             ".atlas");
    std::filesystem::remove(path_);  // of a run that was cut short
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Result<Atlas> read(const std::string& bytes, const manoeuvre::Car& car = small_atlas_car()) {
    EXPECT_EQ(write_file(path_, bytes), std::nullopt);
    return read_atlas(path_, car);
  }
  void expect_refused(const std::string& bytes, const std::string& words) {
    const auto result = read(bytes);
    ASSERT_FALSE(result.has_value()) << words;
    EXPECT_EQ(result.error().code, Error::Code::malformed);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
    EXPECT_EQ(result.error().message.rfind(path_.string(), 0), 0U);
  }
  std::filesystem::path path_;
};

TEST_F(AtlasFile, HoldsWhatWasWritten) {
  const auto atlas = read(good());
  ASSERT_TRUE(atlas.has_value()) << atlas.error().message;
  const auto nodes = atlas.value().nodes();
  ASSERT_EQ(nodes.size(), small_nodes().size());
  EXPECT_EQ(std::memcmp(nodes.data(), small_nodes().data(), nodes.size_bytes()), 0);
  EXPECT_EQ(grid_hash(atlas.value().grid()), grid_hash(small_grid()));
}

TEST_F(AtlasFile, OutlivesTheFile) {
  const auto atlas = read(good());
  std::filesystem::remove(path_);
  EXPECT_EQ(atlas.value().nodes()[1].end, small_nodes()[1].end);
}

TEST_F(AtlasFile, MayBeCutOrOverwrittenWhileItIsHeld) {
  const auto atlas = read(good());
  ASSERT_TRUE(atlas.has_value());
  std::filesystem::resize_file(path_, 10);
  const auto nodes = atlas.value().nodes();
  EXPECT_EQ(std::memcmp(nodes.data(), small_nodes().data(), nodes.size_bytes()), 0);
  std::filesystem::resize_file(path_, good().size());  // in place: all zeros from there on
  EXPECT_EQ(std::memcmp(nodes.data(), small_nodes().data(), nodes.size_bytes()), 0);
}

// Sums hold, so what wrote it meant it.
TEST_F(AtlasFile, WithoutFiniteNumbersIsRefused) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto bytes_with = [](const std::function<void(AtlasNode&)>& change) {
    auto nodes = small_nodes();
    change(nodes[1]);
    return atlas_bytes(small_atlas_car(), small_grid(), nodes);
  };
  const std::string words = "node 1: want finite scales and times of 0 s or more";
  expect_refused(bytes_with([](AtlasNode& node) { node.span = nan; }), words);
  expect_refused(bytes_with([](AtlasNode& node) { node.end = infinite; }), words);
  expect_refused(bytes_with([](AtlasNode& node) { node.sensitivity_span = -1.0F; }), words);
  expect_refused(bytes_with([](AtlasNode& node) { node.scale[5] = nan; }), words);
  expect_refused(bytes_with([](AtlasNode& node) { node.sensitivity_scale[0] = infinite; }), words);
  AtlasGrid grid = small_grid();
  grid[0].speeds[grid[0].speeds.size() - 1] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(atlas_bytes(small_atlas_car(), grid, small_nodes()), "header was altered");
}

TEST_F(AtlasFile, ThatIsAPipeOrADeviceIsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  const auto pipe = read_atlas(path_, small_atlas_car());
  ASSERT_FALSE(pipe.has_value());
  EXPECT_NE(pipe.error().message.find("is a pipe"), std::string::npos);
  EXPECT_FALSE(read_atlas("/dev/zero", small_atlas_car()).has_value());
}

TEST_F(AtlasFile, WithAnyByteChangedIsRefused) {
  // Sign, version, order, sizes, counts, hashes, behaviour, grid, sum, and the first, some and the
  // last of the nodes.
  const std::size_t body = good().size() - small_nodes().size() * sizeof(AtlasNode);
  for (const std::size_t place :
       {std::size_t{0}, std::size_t{8}, std::size_t{12}, std::size_t{16}, std::size_t{24},
        std::size_t{32}, std::size_t{40}, std::size_t{48}, std::size_t{60}, std::size_t{500},
        body - 9, body - 1, body, body + 40, body + 2000, good().size() - 1}) {
    for (const int bit : {0, 7}) {
      std::string bytes = good();
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << bit));
      EXPECT_FALSE(read(bytes).has_value()) << "byte " << place;
    }
  }
}

TEST_F(AtlasFile, CutShortOrLengthenedIsRefused) {
  expect_refused("", "cut short");
  expect_refused(good().substr(0, 100), "cut short");
  expect_refused(good().substr(0, good().size() - 1), "it is not whole");
  expect_refused(good() + "x", "it is not whole");
}

TEST_F(AtlasFile, OfAnotherKindOrVersionIsRefused) {
  expect_refused(std::string(100'000, 'x'), "is no atlas");
  std::string older = good();
  older[8] = 77;
  expect_refused(older, "version");
  std::string turned = good();
  std::swap(turned[12], turned[15]);
  expect_refused(turned, "order of bytes");
}

TEST_F(AtlasFile, OfAnotherCarIsRefused) {
  manoeuvre::Car other = small_atlas_car();
  other.mass += 1.0;
  const auto refused = read(good(), other);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::out_of_range);
  EXPECT_NE(refused.error().message.find("another car"), std::string::npos);
}

// A file whose sums hold and which is of the same car, but whose drives this program would not
// drive so: what a program with another controller writes.
TEST_F(AtlasFile, OfAnotherControllerIsRefused) {
  const std::size_t body = good().size() - small_nodes().size() * sizeof(AtlasNode);
  const std::size_t driven = 56;  // after sign, version, order, three sizes, car, sum of the nodes
  const std::size_t sum = body - sizeof(std::uint64_t);
  const auto with = [&](double change) {
    std::string bytes = good();
    double number = 0.0;
    std::memcpy(&number, bytes.data() + driven, sizeof number);
    EXPECT_EQ(number, behaviour(small_atlas_car())[0]);
    number += change;
    std::memcpy(bytes.data() + driven, &number, sizeof number);
    Fnv hash;
    hash.add(std::string_view(bytes).substr(0, sum));
    const std::uint64_t value = hash.value();
    std::memcpy(bytes.data() + sum, &value, sizeof value);
    return bytes;
  };
  EXPECT_TRUE(read(with(0.0)).has_value());
  const auto refused = read(with(0.01));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::out_of_range);
  EXPECT_NE(refused.error().message.find("controller"), std::string::npos);
}

TEST_F(AtlasFile, ThatIsNotThereIsTold) {
  const auto refused = read_atlas(path_ / "no", small_atlas_car());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, Error::Code::unreadable);
  const auto folder = read_atlas(std::filesystem::temp_directory_path(), small_atlas_car());
  ASSERT_FALSE(folder.has_value());
}

TEST_F(AtlasFile, TellsOfItselfWhosever) {
  EXPECT_EQ(write_file(path_, good()), std::nullopt);
  const auto info = read_atlas_info(path_);
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info.value().bytes, good().size());
  EXPECT_EQ(info.value().car, car_hash(small_atlas_car()));
}

}  // namespace
}  // namespace saca::atlas::atlas_file_test
