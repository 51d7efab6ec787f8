#include "saca/thinking/danger/value_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"

namespace saca::danger::value_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double pi = std::numbers::pi;

Grid small_grid() {
  return {
      {{.name = "x", .first = -4.0, .last = 3.0, .points = 9, .stretch = 1.5},
       {.name = "y", .first = 0.0, .last = 2.0, .points = 5, .edge = Edge::mirrored, .turned = 2},
       {.name = "course", .first = -pi, .last = pi, .points = 6, .edge = Edge::periodic}}};
}

template <class Real>
std::vector<Real> any_values(std::size_t size, unsigned seed) {
  std::mt19937 chance(seed);
  std::normal_distribution<Real> any(0, 3);
  std::vector<Real> values(size);
  for (Real& value : values) {
    value = any(chance);
  }
  return values;
}

template <class Real>
Solution small_solved() {
  Solution solved{.grid = small_grid(),
                  .problem = "[obstacle]\nshape = \"ellipse\"  # \xc3\xa4\n",
                  .scheme = "weno5, in words",
                  .complete = true,
                  .times = {0.0, 0.5, 2.0}};
  Snapshots<Real> values;
  for (unsigned time = 0; time < 3; ++time) {
    values.push_back(any_values<Real>(num_cells(solved.grid), time));
  }
  solved.values = values;
  return solved;
}

class ValueFile : public ::testing::Test {
 protected:
  ValueFile() {
    std::string name = (fs::temp_directory_path() / "saca_value_file_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "a.h5";
  }
  ~ValueFile() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string bytes() const { return read_file(path_).value(); }
  void put(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  /// What reading refuses with; "" when it does not.
  [[nodiscard]] std::string refusal() const {
    const auto solved = read_solved(path_);
    return solved.has_value() ? "" : solved.error().message;
  }

  /// Changes the HDF5 part with HDF5's own means, and makes the check sum fit again.
  void edit(const std::function<void(hid_t)>& change) const {
    ASSERT_FALSE(write_solved(path_, small_solved<float>()));
    const fs::path plain = folder_ / "plain.h5";
    std::ofstream(plain, std::ios::binary) << bytes().substr(512);
    const hid_t file = H5Fopen(plain.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    ASSERT_GE(H5Fclose(file), 0);
    put(checksummed(read_file(plain).value()));
  }

  /// As docs/formats.md tells it.
  [[nodiscard]] static std::string checksummed(const std::string& body,
                                               const std::string& format = "saca.value/2") {
    Fnv sum;
    sum.add(body);
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx",
                  static_cast<unsigned long long>(sum.value()));
    std::string head =
        format + "\nbytes " + std::to_string(body.size()) + "\nfnv1a " + digits.data() + "\n";
    head.resize(512, '\0');
    return head + body;
  }

  fs::path folder_, path_;
};

void set_number(hid_t file, const char* group, const char* name, double value) {
  const hid_t object = H5Oopen(file, group, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), 0);
  H5Aclose(attribute);
  H5Oclose(object);
}

void put_set(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& shape,
             const std::vector<float>& values) {
  if (H5Lexists(file, name, H5P_DEFAULT) > 0) {
    H5Ldelete(file, name, H5P_DEFAULT);
  }
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  if (!values.empty()) {
    ASSERT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  }
  H5Dclose(set);
  H5Sclose(space);
}

template <class Real>
void expect_same(const Solution& came, const Solution& wanted) {
  ASSERT_EQ(came.grid.axes.size(), wanted.grid.axes.size());
  for (std::size_t d = 0; d < wanted.grid.axes.size(); ++d) {
    const Axis& a = came.grid.axes[d];
    const Axis& b = wanted.grid.axes[d];
    EXPECT_EQ(std::tie(a.name, a.first, a.last, a.points, a.edge, a.stretch, a.turned),
              std::tie(b.name, b.first, b.last, b.points, b.edge, b.stretch, b.turned));
  }
  EXPECT_EQ(came.problem, wanted.problem);
  EXPECT_EQ(came.scheme, wanted.scheme);
  EXPECT_EQ(came.complete, wanted.complete);
  EXPECT_EQ(came.times, wanted.times);
  EXPECT_EQ(came.error, wanted.error);
  EXPECT_EQ(std::get<Snapshots<Real>>(came.values), std::get<Snapshots<Real>>(wanted.values));
}

TEST_F(ValueFile, GivesBackEveryBitInBothPrecisions) {
  Solution solved = small_solved<float>();
  solved.error = std::vector<float>(num_cells(solved.grid), 0.25F);
  ASSERT_FALSE(write_solved(path_, solved));
  expect_same<float>(read_solved(path_).value(), solved);
  solved = small_solved<double>();
  solved.complete = false;
  solved.problem = "";
  solved.scheme = "";
  ASSERT_FALSE(write_solved(path_, solved));
  expect_same<double>(read_solved(path_).value(), solved);
}

TEST_F(ValueFile, IsPlainHdf5ForOthersWithTheFastestAxisLast) {
  const Solution solved = small_solved<float>();
  ASSERT_FALSE(write_solved(path_, solved));
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t set = H5Dopen2(file, "values", H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  std::array<hsize_t, 4> shape{};
  ASSERT_EQ(H5Sget_simple_extent_ndims(space), 4);
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  EXPECT_EQ(shape, (std::array<hsize_t, 4>{3, 6, 5, 9}));
  std::vector<float> values(3 * num_cells(solved.grid));
  ASSERT_GE(H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  EXPECT_EQ(values[270 + 7], std::get<Snapshots<float>>(solved.values)[1][7]);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
}

TEST_F(ValueFile, TheSameValuesMakeTheSameBytes) {
  ASSERT_FALSE(write_solved(path_, small_solved<float>()));
  const std::string first = bytes();
  ASSERT_FALSE(write_solved(path_, small_solved<float>()));
  EXPECT_EQ(bytes(), first);
}

TEST_F(ValueFile, ASnapshotIsFloatInBothPrecisions) {
  const Solution solved = small_solved<double>();
  const std::vector<float> values = snapshot(solved, 2);
  EXPECT_EQ(values[5], static_cast<float>(std::get<Snapshots<double>>(solved.values)[2][5]));
  EXPECT_TRUE(solved.doubles());
  EXPECT_THROW((void)snapshot(solved, 3), ContractViolation);
  EXPECT_EQ(nearest_snapshot(solved, 0.3), 1U);
  EXPECT_EQ(nearest_snapshot(solved, 9.0), 2U);
}

// --- refusals
// -------------------------------------------------------------------------------------

TEST_F(ValueFile, RefusesWhatIsNoSuchFile) {
  EXPECT_THAT(refusal(), HasSubstr("a.h5: cannot be opened"));
  put("");
  EXPECT_THAT(refusal(), HasSubstr("a.h5: want a file of saca.value/2, got an empty file"));
  put("# TOML\nname = 1\n");
  EXPECT_THAT(refusal(), HasSubstr("got something else"));
  ASSERT_FALSE(write_solved(path_, small_solved<float>()));
  const std::string body = bytes().substr(512);
  put(body);
  EXPECT_THAT(refusal(), HasSubstr("got HDF5 of another kind"));
  put(checksummed(body, "saca.value/3"));
  EXPECT_THAT(refusal(), HasSubstr("want a file of saca.value/2, got saca.value/3"));
  put(checksummed("no HDF5 at all, but well sealed"));
  EXPECT_THAT(refusal(), HasSubstr("file: want HDF5, got what HDF5 cannot open"));
}

TEST_F(ValueFile, RefusesAFileThatIsCutOffAnywhere) {
  ASSERT_FALSE(write_solved(path_, small_solved<float>()));
  const std::string whole = bytes();
  for (std::size_t length = 0; length < whole.size();
       length += length < 600 ? 13 : whole.size() / 97) {
    put(whole.substr(0, length));
    EXPECT_THAT(refusal(), HasSubstr("a.h5: want a file of saca.value/2, got")) << length;
  }
  put(whole + "x");
  EXPECT_THAT(refusal(), HasSubstr("cut off or damaged"));
}

TEST_F(ValueFile, RefusesAFileWithAnyBitTurned) {
  ASSERT_FALSE(write_solved(path_, small_solved<float>()));
  const std::string whole = bytes();
  std::mt19937 chance(31);
  for (int i = 0; i < 300; ++i) {
    std::string changed = whole;
    const std::size_t range = i % 2 == 0 ? 512 : whole.size();
    char& byte = changed[chance() % range];
    byte = static_cast<char>(byte ^ static_cast<char>(1U << chance() % 8U));
    put(changed);
    EXPECT_THAT(refusal(), HasSubstr("a.h5: want a file of saca.value/2, got"));
  }
}

TEST_F(ValueFile, RefusesAPartThatIsMissing) {
  for (const char* const set : {"problem", "times", "values"}) {
    edit([&](hid_t file) { H5Ldelete(file, set, H5P_DEFAULT); });
    EXPECT_THAT(refusal(),
                HasSubstr("a.h5: data set " + std::string(set) + ": want one, got none"));
  }
  for (const char* const name : {"name", "first", "last", "points", "edge", "stretch", "turned"}) {
    edit([&](hid_t file) { H5Adelete_by_name(file, "axis_1", name, H5P_DEFAULT); });
    EXPECT_THAT(refusal(), HasSubstr("a.h5: attribute axis_1/" + std::string(name) + ": want "));
  }
  for (const char* const name : {"format", "complete", "scheme", "dimensions"}) {
    edit([&](hid_t file) { H5Adelete_by_name(file, ".", name, H5P_DEFAULT); });
    EXPECT_THAT(refusal(), HasSubstr("a.h5: attribute " + std::string(name) + ": want "));
  }
  edit([](hid_t file) { H5Ldelete(file, "axis_2", H5P_DEFAULT); });
  EXPECT_THAT(refusal(), HasSubstr("attribute axis_2/name"));
}

TEST_F(ValueFile, RefusesAGridThatBreaksARule) {
  edit([](hid_t file) { set_number(file, "axis_0", "last", -5.0); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: grid: axis 1 (x): wanted first < last"));
  edit([](hid_t file) {
    set_number(file, "axis_0", "stretch", std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: grid: axis 1 (x): wanted stretch"));
  edit([](hid_t file) { set_number(file, "axis_1", "points", 2e9); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: grid: want at most 4294967296 cells, got more"));
  edit([](hid_t file) { set_number(file, ".", "dimensions", 5.0); });
  EXPECT_THAT(refusal(), HasSubstr("want a whole number in [1, 4], got 5"));
}

TEST_F(ValueFile, RefusesDataOfAnotherShapeOrType) {
  const std::vector<float> some(10, 1.0F);
  edit([&](hid_t file) { put_set(file, "values", H5T_IEEE_F32LE, {2, 5}, some); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set values: want 3 x 6 x 5 x 9 numbers, got 2 x 5"));
  edit([&](hid_t file) { put_set(file, "error", H5T_IEEE_F32LE, {10}, some); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set error: want 6 x 5 x 9 numbers, got 10"));
  const std::vector<float> many(810, 1.0F);
  edit([&](hid_t file) { put_set(file, "values", H5T_STD_I32LE, {3, 6, 5, 9}, many); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set values: want numbers of 4 bytes"));
  edit([&](hid_t file) { put_set(file, "times", H5T_IEEE_F64LE, {3}, {0.0F, 2.0F, 2.0F}); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set times: want times that increase, got 0, 2, 2"));
  edit([&](hid_t file) { put_set(file, "times", H5T_IEEE_F64LE, {2}, {0.0F, 2.0F}); });
  EXPECT_THAT(refusal(), HasSubstr("want 2 x 6 x 5 x 9 numbers, got 3 x 6 x 5 x 9"));
  edit([&](hid_t file) { put_set(file, "problem", H5T_IEEE_F64LE, {2}, {0.0F, 2.0F}); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set problem: want a text"));
}

TEST_F(ValueFile, RefusesWhatIsNoNumberAndSaysWhere) {
  std::vector<float> values(810, 1.0F);
  values[270 + 33] = std::numeric_limits<float>::quiet_NaN();
  edit([&](hid_t file) { put_set(file, "values", H5T_IEEE_F32LE, {3, 6, 5, 9}, values); });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set values: want finite numbers, got nan at 33"));
  edit([&](hid_t file) {
    put_set(file, "error", H5T_IEEE_F32LE, {6, 5, 9}, std::vector<float>(270, -1.0F));
  });
  EXPECT_THAT(refusal(), HasSubstr("a.h5: data set error: want numbers >= 0"));
}

TEST_F(ValueFile, ARefusalIsOneLine) {
  edit([](hid_t file) { H5Ldelete(file, "times", H5P_DEFAULT); });
  EXPECT_THAT(refusal(), Not(HasSubstr("\n")));
}

TEST_F(ValueFile, SaysWhenItCannotBeWritten) {
  const auto problem = write_solved(folder_ / "none" / "a.h5", small_solved<float>());
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->code, Error::Code::unwritable);
  EXPECT_THAT(problem->message, HasSubstr("a.h5: cannot be created"));
}

TEST_F(ValueFile, WritesNothingThatItWouldNotRead) {
  const auto refuses = [&](const std::function<void(Solution&)>& change) {
    Solution solved = small_solved<float>();
    change(solved);
    EXPECT_THROW((void)write_solved(path_, solved), ContractViolation);
  };
  refuses([](Solution& s) { s.grid.axes.clear(); });
  refuses([](Solution& s) { s.times = {0.0, 0.0, 1.0}; });
  refuses([](Solution& s) { s.times.pop_back(); });
  refuses([](Solution& s) { std::get<0>(s.values)[1].pop_back(); });
  refuses([](Solution& s) { std::get<0>(s.values)[1][4] = std::nanf(""); });
  refuses([](Solution& s) { s.error = {1.0F}; });
  EXPECT_FALSE(fs::exists(path_));
}

}  // namespace
}  // namespace saca::danger::value_file_test
