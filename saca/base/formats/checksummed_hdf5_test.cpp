#include "saca/base/formats/checksummed_hdf5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "saca/base/core/file.h"

namespace saca::formats::checksummed_hdf5_test {
namespace {

using testing::HasSubstr;

std::string path_of(const std::string& name) {
  return testing::TempDir() + "sealed_hdf5_test_" + name;
}

double value_in(Hdf5Reader& reader) {
  return reader.number(".", "value");
}

void write_value(const std::string& path) {
  Hdf5Writer writer;
  writer.attribute(".", "value", 4.5);
  ASSERT_FALSE(write_sealed_hdf5(path, "saca.number/1", writer));
}

TEST(SealedHdf5, GivesBackWhatWasWritten) {
  const std::string path = path_of("back.h5");
  write_value(path);
  const auto read = read_sealed_hdf5(path, "saca.number/1", value_in);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read.value(), 4.5);
}

TEST(SealedHdf5, RefusesAnotherFormatAndDamage) {
  const std::string path = path_of("damage.h5");
  write_value(path);
  EXPECT_THAT(read_sealed_hdf5(path, "saca.number/2", value_in).error().message,
              HasSubstr("want a file of saca.number/2"));
  std::string bytes = read_file(path).value();
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  ASSERT_FALSE(write_file(path, bytes));
  EXPECT_THAT(read_sealed_hdf5(path, "saca.number/1", value_in).error().message,
              HasSubstr("damaged"));
  EXPECT_EQ(read_sealed_hdf5(path_of("none.h5"), "saca.number/1", value_in).error().code,
            Error::Code::unreadable);
}

TEST(SealedHdf5, RefusesAnHeadThatBeliesTheFormat) {
  const std::string path = path_of("belied.h5");
  {
    Hdf5Writer writer;
    writer.attribute(".", "format", std::string("saca.other/1"));
    ASSERT_FALSE(write_checksummed(path, "saca.number/1", writer.bytes().value()));
  }
  EXPECT_THAT(read_sealed_hdf5(path, "saca.number/1", value_in).error().message,
              HasSubstr("want saca.number/1, got saca.other/1"));
}

TEST(SealedHdf5, AMissingPartIsTheError) {
  const std::string path = path_of("part.h5");
  write_value(path);
  const auto read = read_sealed_hdf5(path, "saca.number/1",
                                     [](Hdf5Reader& reader) { return reader.number(".", "none"); });
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, Error::Code::malformed);
}

TEST(SealedHdf5, NothingIsThrown) {
  const std::string path = path_of("throws.h5");
  write_value(path);
  const auto read = read_sealed_hdf5(path, "saca.number/1", [](Hdf5Reader& reader) -> double {
    throw std::length_error(reader.problem() ? "problem" : "too much");
  });
  EXPECT_THAT(read.error().message, HasSubstr("cannot be read: too much"));
}

}  // namespace
}  // namespace saca::formats::checksummed_hdf5_test
