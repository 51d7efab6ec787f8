#include "saca/lab/prepare/harm_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "saca/base/core/file.h"

namespace saca::prepare::harm_file_test {
namespace {

using testing::HasSubstr;

const std::filesystem::path data_file = "data/harm.toml";

// The file with one line changed.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = read_file(data_file).value();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ParseHarm, SaysWhatIsWrongAndWhere) {
  const auto problem = [](const std::string& text) {
    const auto model = parse_harm(text, "harm.toml");
    return model.has_value() ? std::string() : model.error().message;
  };
  EXPECT_EQ(problem(changed("severe = 1.0", "severe = 2.0")), "");
  EXPECT_THAT(problem(changed("slope_per_mps = 0.177", "slope_per_mps = -0.177")),
              HasSubstr("slope_per_mps"));
  EXPECT_THAT(problem(changed("slope_per_mps = 0.177", "slope_per_kmh = 0.177")),
              HasSubstr("slope_per_mps"));
  EXPECT_THAT(problem(changed("killed_share = 0.16", "killed_share = 1.6")),
              HasSubstr("killed_share"));
  EXPECT_THAT(problem(changed("restitution = 0.1", "restitution = nan")), HasSubstr("restitution"));
  EXPECT_THAT(problem(changed("bicycle = 1.0", "bicycle = -1.0")), HasSubstr("bicycle"));
  EXPECT_THAT(problem(changed("van = 1.5", "van = 1.5\nlorry = 1.0")), HasSubstr("lorry"));
  EXPECT_THAT(problem("weight = 3"), HasSubstr("harm.toml"));
  EXPECT_FALSE(parse_harm("", "harm.toml").has_value());
  EXPECT_FALSE(parse_harm("[", "harm.toml").has_value());
}

TEST(ReadHarm, NamesAFileThatIsNotThere) {
  const auto model = read_harm("no_such_harm.toml");
  ASSERT_FALSE(model.has_value());
  EXPECT_EQ(model.error().code, Error::Code::unreadable);
  EXPECT_THAT(model.error().message, HasSubstr("no_such_harm.toml"));
}

}  // namespace
}  // namespace saca::prepare::harm_file_test
