#include "saca/lab/runs/run_files.h"

#include <gmock/gmock.h>

#include <memory>

#include "saca/base/core/file.h"
#include "saca/lab/runs/walker_for_test.h"
#include "saca/runtime/read_tape.h"

namespace saca::runs::run_files_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    walker_ = std::make_unique<Walker>();
    walker_->setup.tapes = true;
    encounter::Silence quiet;
    record_ = std::make_unique<encounter::Record>(encounter::run(walker_->setup, quiet).value());
    text_ = encounter::record_json(walker_->setup, *record_);
  }
  static void TearDownTestSuite() {
    record_.reset();
    walker_.reset();
  }
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] static PlayedRun played() {
    return {.setup = walker_->setup, .record = *record_, .record_text = text_, .program = "9.9.9"};
  }

  static inline std::unique_ptr<Walker> walker_;
  static inline std::unique_ptr<encounter::Record> record_;
  static inline std::string text_;
  const fs::path folder_ = fs::path(testing::TempDir()) / "run_files_test";
};

TEST_F(Files, AreAllThatAreWanted) {
  const RunFiles files{.record = folder_ / "a" / "record.json",
                       .report = folder_ / "report.html",
                       .trace = folder_ / "trace.csv",
                       .tape = folder_ / "tape"};
  ASSERT_EQ(write_run(files, played()), std::nullopt);
  EXPECT_EQ(read_file(files.record, many_bytes).value(), text_);
  EXPECT_THAT(read_file(files.report, many_bytes).value(), HasSubstr("</html>"));
  EXPECT_THAT(read_file(files.trace, many_bytes).value(), testing::Not(StartsWith("{")));
  const auto tape = runtime::read_tape(read_file(files.tape, many_bytes).value(), "tape");
  ASSERT_TRUE(tape.has_value()) << tape.error().message;
  EXPECT_EQ(tape.value().header.program, "9.9.9");
  EXPECT_EQ(tape.value().header.scenario, "walker");
}

TEST_F(Files, OfAnotherEndingHoldALineOfJsonForEachFrame) {
  ASSERT_EQ(write_run({.trace = folder_ / "trace.jsonl"}, played()), std::nullopt);
  EXPECT_THAT(read_file(folder_ / "trace.jsonl", many_bytes).value(), StartsWith("{"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Files, EndWithTheFirstThatCannotBeWritten) {
  ASSERT_EQ(write_run({.trace = folder_ / "file.csv"}, played()), std::nullopt);
  const auto problem = write_run({.record = folder_ / "record.json",
                                  .report = folder_ / "file.csv" / "report.html",
                                  .tape = folder_ / "tape"},
                                 played());
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->code, Error::Code::unwritable);
  EXPECT_TRUE(fs::exists(folder_ / "record.json"));
  EXPECT_FALSE(fs::exists(folder_ / "tape"));
}

TEST_F(Files, HoldWhatIsToldInShort) {
  EXPECT_THAT(in_short(text_), testing::Contains(HasSubstr("pedestrian1")));
  EXPECT_THAT(in_short("no record"), IsEmpty());
}

}  // namespace
}  // namespace saca::runs::run_files_test
