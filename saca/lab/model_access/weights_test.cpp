#include "saca/lab/model_access/weights.h"

#include <gmock/gmock.h>

#include <string>

#include "saca/base/core/file.h"

namespace saca::model_access::weights_test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

fs::path file_of_test(const std::string& name, const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / ("weights_test_" + name);
  EXPECT_EQ(write_file(file, text), std::nullopt);
  return file;
}

TEST(Temperature, IsThatOfTheNameThatTheFileBeginsWith) {
  const fs::path file = file_of_test("t.toml", R"(
[[weights]]
name = "Small-1B"
temperature = 3.5
[[weights]]
name = "Small-1B-tuned"
temperature = 2.0
)");
  EXPECT_EQ(temperature_of(file, "Small-1B-Q8.gguf").value(), 3.5);
  EXPECT_EQ(temperature_of(file, "Small-1B-tuned-Q8.gguf").value(), 2.0);
  EXPECT_EQ(temperature_of(file, "Large-Small-1B.gguf").value(), 1.0);
}

TEST(Temperature, OfTheShippedFileIsAtLeastOneForTheWeightsThatAreTaught) {
  const auto found = temperature_of("data/language_model.toml", "saca-SmolLM2-135M.Q8_0.gguf");
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(found.value(), 1.0);
}

TEST(Temperature, ThatIsNoneIsRefusedByFileAndKey) {
  EXPECT_THAT(temperature_of("nowhere.toml", "x").error().message, HasSubstr("nowhere.toml"));
  const fs::path file =
      file_of_test("wrong.toml", "[[weights]]\nname = \"x\"\ntemperature = 0.0\n");
  EXPECT_THAT(temperature_of(file, "y").error().message,
              testing::AllOf(HasSubstr("wrong.toml"), HasSubstr("temperature")));
}

/// As many bytes as need not all be read, with a mark somewhere.
std::string many(std::size_t at) {
  std::string bytes(300'000, 'w');
  bytes[at] = 'x';
  return bytes;
}

TEST(AFingerprint, TellsWeightsApartByTheirEndsAndSize) {
  const auto of = [](const std::string& bytes) {
    return fingerprint({.weights = file_of_test("w.gguf", bytes), .system = "You are"});
  };
  const std::string first = of(many(150'000));
  EXPECT_THAT(first, testing::MatchesRegex("[0-9a-f]{8}"));
  EXPECT_EQ(first, of(many(150'001)));  // the middle is not read
  EXPECT_NE(first, of(many(10)));
  EXPECT_NE(first, of(many(299'990)));
  EXPECT_NE(first, of(many(150'000) + "w"));
}

TEST(AFingerprint, ChangesWithPromptTemperatureAndArithmetic) {
  const AnsweringModel model{.weights = file_of_test("v.gguf", "short"), .system = "You are"};
  const std::string first = fingerprint(model);
  EXPECT_EQ(first, fingerprint(model));
  AnsweringModel other = model;
  other.system = "You were";
  EXPECT_NE(first, fingerprint(other));
  other = model;
  other.temperature = 1.5;
  EXPECT_NE(first, fingerprint(other));
  other = model;
  other.flash_attention = true;
  EXPECT_NE(first, fingerprint(other));
}

}  // namespace
}  // namespace saca::model_access::weights_test
