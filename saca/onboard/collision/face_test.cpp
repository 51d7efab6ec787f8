#include "saca/onboard/collision/face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"

namespace saca::collision::face_test {
namespace {

constexpr world::Footprint car{.length = 4.7, .width = 1.9};
constexpr world::Footprint person{.shape = world::Shape::ellipse, .length = 0.3, .width = 0.5};

Vec2 at(double degrees) {
  return rotated({1.0, 0.0}, from_degrees(degrees));
}

TEST(StruckFace, OfABoxIsTheOneWithin45Degrees) {
  EXPECT_EQ(struck_face(car, at(0.0)), Face::front);
  EXPECT_EQ(struck_face(car, at(44.0)), Face::front);
  EXPECT_EQ(struck_face(car, at(46.0)), Face::left);
  EXPECT_EQ(struck_face(car, at(134.0)), Face::left);
  EXPECT_EQ(struck_face(car, at(136.0)), Face::rear);
  EXPECT_EQ(struck_face(car, at(-136.0)), Face::rear);
  EXPECT_EQ(struck_face(car, at(-134.0)), Face::right);
  EXPECT_EQ(struck_face(car, at(-46.0)), Face::right);
}

// The normal (cos, sin) touches an ellipse on the diagonal of its box where tan = length / width:
// for 0.3 x 0.5 that is at 30.96 degrees.
TEST(StruckFace, OfAnEllipseIsTheQuarterOfTheTouchedPoint) {
  EXPECT_EQ(struck_face(person, at(30.0)), Face::front);
  EXPECT_EQ(struck_face(person, at(32.0)), Face::left);
  EXPECT_EQ(struck_face(person, at(-32.0)), Face::right);
  EXPECT_EQ(struck_face(person, at(180.0 - 30.0)), Face::rear);
}

TEST(StruckFace, OnTheDividingLineIsFrontOrRearOnBothSides) {
  EXPECT_EQ(struck_face(car, at(45.0)), Face::front);
  EXPECT_EQ(struck_face(car, at(-45.0)), Face::front);
  EXPECT_EQ(struck_face(car, at(135.0)), Face::rear);
  EXPECT_EQ(struck_face(car, at(-135.0)), Face::rear);
}

TEST(StruckFace, RefusesNoDirection) {
  EXPECT_THROW((void)struck_face(car, {0.0, 0.0}), ContractViolation);
  EXPECT_THROW((void)struck_face(car, {std::numeric_limits<double>::quiet_NaN(), 0.0}),
               ContractViolation);
}

TEST(FaceName, IsTheWordForIt) {
  EXPECT_EQ(name(Face::front), "front");
  EXPECT_EQ(name(Face::left), "left");
  EXPECT_EQ(name(Face::right), "right");
  EXPECT_EQ(name(Face::rear), "rear");
}

}  // namespace
}  // namespace saca::collision::face_test
