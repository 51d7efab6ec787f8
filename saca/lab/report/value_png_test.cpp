#include "saca/lab/report/value_png.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

namespace saca::report::value_png_test {
namespace {

/// A PNG, decoded by Cairo's reader.
class Decoded {
 public:
  explicit Decoded(std::string bytes) : bytes_(std::move(bytes)) {
    const auto read = [](void* from, unsigned char* to, unsigned length) {
      auto& self = *static_cast<Decoded*>(from);
      if (self.at_ + length > self.bytes_.size()) {
        return CAIRO_STATUS_READ_ERROR;
      }
      std::memcpy(to, self.bytes_.data() + self.at_, length);
      self.at_ += length;
      return CAIRO_STATUS_SUCCESS;
    };
    surface_.reset(cairo_image_surface_create_from_png_stream(read, this));
    EXPECT_EQ(cairo_surface_status(surface_.get()), CAIRO_STATUS_SUCCESS);
  }
  [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
  [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }
  [[nodiscard]] Rgb at(int x, int y) const {
    const unsigned char* const p = pixel(x, y);
    return {p[2], p[1], p[0]};
  }
  [[nodiscard]] int count(const Rgb& colour) const {
    int found = 0;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        found += at(x, y) == colour ? 1 : 0;
      }
    }
    return found;
  }

 private:
  [[nodiscard]] const unsigned char* pixel(int x, int y) const {
    return cairo_image_surface_get_data(surface_.get()) +
           y * cairo_image_surface_get_stride(surface_.get()) + 4 * x;
  }
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };
  std::string bytes_;
  std::size_t at_ = 0;
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
};

ValueMap quarters() {  // 3 x 2, the upper right one outside
  return {.x = {-10.0, 20.0},
          .y = {-5.0, 10.0},
          .columns = 3,
          .rows = 2,
          .values = {-20.0F, -8.0F, 0.0F, 2.0F, 0.8F, 1.0F},
          .inside = {1, 1, 1, 1, 1, 0}};
}

ValuePicture picture() {
  return {.map = quarters(),
          .scale = {.lowest = -20.0, .highest = 2.0},
          .title = "parked_car",
          .lines = {"V over x and y", "course 0 deg"},
          .x = {"x", "m", -10.0, 20.0},
          .y = {"y", "m", -5.0, 10.0},
          .value_words = "V [m]",
          .outline = {{-2.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {-2.0, 1.0}},
          .course = 0.0};
}

/// In each of red, green and blue: what is blended may be off by two.
int farthest(const Rgb& a, const Rgb& b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

TEST(ValuePng, HasTheHighestYOnTopAndNoColourOutside) {
  ValuePicture plain = picture();
  plain.outline.clear();
  plain.course.reset();
  plain.map.values[2] = 0.4F;  // so that no zero line runs through a middle
  const Decoded png(value_png(plain).value());
  const RasterSize size = raster_size(plain.x, plain.y);
  const auto middle = [&](int column, int row_from_top) {  // the plot begins at (78, 82)
    return png.at(78 + (2 * column + 1) * size.columns / 6,
                  82 + (2 * row_from_top + 1) * size.rows / 4);
  };
  EXPECT_LE(farthest(middle(0, 0), danger_colours.back()), 2);  // 2.0
  EXPECT_LE(farthest(middle(1, 0), danger_colours[2]), 2);      // 0.8: two fifths
  EXPECT_LE(farthest(middle(0, 1), safety_colours.back()), 2);  // -20
  EXPECT_LE(farthest(middle(1, 1), safety_colours[2]), 2);      // -8: two fifths
  EXPECT_LE(farthest(middle(2, 1), danger_colours[1]), 2);      // 0.4: a fifth
  EXPECT_LE(farthest(middle(2, 0), (Rgb{222, 226, 230})), 2);
}

TEST(ValuePng, DrawsEqualUnitsToScale) {
  const RasterSize size = raster_size({"x", "m", -60.0, 60.0}, {"y", "m", -30.0, 30.0});
  EXPECT_EQ(size.rows * 2, size.columns);
  const RasterSize narrow = raster_size({"x", "m", 0.0, 100.0}, {"y", "m", 0.0, 1.0});
  EXPECT_GE(narrow.rows, 200);
}

TEST(ValuePng, HasTheColoursTheObstacleAndTheZeroLine) {
  const auto bytes = value_png(picture());
  ASSERT_TRUE(bytes.has_value());
  const Decoded png(bytes.value());
  const RasterSize size = raster_size(picture().x, picture().y);
  EXPECT_GT(png.width(), size.columns);
  EXPECT_GT(png.height(), size.rows);
  EXPECT_GT(png.count({230, 0, 0}), 100);  // the outline, about 4 m x 25 px
  ValuePicture without = picture();
  without.outline.clear();
  EXPECT_EQ(Decoded(value_png(without).value()).count({230, 0, 0}), 0);
  const Rgb line{23, 32, 42};
  const int dark = Decoded(value_png(without).value()).count(line);
  without.map.values = std::vector<float>(6, 1.0F);
  EXPECT_LT(Decoded(value_png(without).value()).count(line), dark - 200);
}

TEST(ValuePng, PutsPicturesRowByRow) {
  const Decoded one(value_png(picture()).value());
  ValuePicture safe = picture();  // all of it dark blue
  safe.map.values = std::vector<float>(6, -20.0F);
  const std::array<ValuePicture, 3> three{picture(), safe, picture()};
  const Decoded sheet(value_png(three, 2).value());
  ASSERT_EQ(sheet.width(), 2 * one.width());
  ASSERT_EQ(sheet.height(), 2 * one.height());
  for (const int x : {one.width() / 3, one.width() / 2}) {
    const int y = one.height() / 2;
    EXPECT_EQ(sheet.at(x, y), one.at(x, y));
    EXPECT_EQ(sheet.at(x, one.height() + y), one.at(x, y));
  }
  const int x = 78 + 760 / 2;  // the middle of a rectangle
  const int y = 82 + 380 / 4;
  EXPECT_LE(farthest(sheet.at(one.width() + x, y), safety_colours.back()), 2);
  EXPECT_EQ(sheet.at(one.width() + x, one.height() + y), (Rgb{255, 255, 255})) << "no fourth";
}

TEST(ValuePng, TheSamePictureMakesTheSameBytes) {
  EXPECT_EQ(value_png(picture()).value(), value_png(picture()).value());
}

}  // namespace
}  // namespace saca::report::value_png_test
