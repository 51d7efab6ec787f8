#include "saca/lab/families/splits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "saca/base/config/config.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/names.h"
#include "saca/base/core/printable.h"
#include "saca/lab/scenario/motion_reader.h"

namespace saca::families {
namespace {

using config::Table;

constexpr std::array<std::string_view, 3> split_names{"tuning", "calibration", "test"};

constexpr std::string_view before_family = ": family ";  // in each line of a log

/// Why lines are not appended to a file that is there.
std::optional<Error> not_a_log(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    return std::nullopt;
  }
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  std::istringstream lines(text.value());
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find(before_family) == std::string::npos) {
      return Error{Error::Code::malformed,
                   fmt::format("{}:{}: want a log of the test split, \"PURPOSE{}NAME\" in each "
                               "line, got \"{}\": nothing was written",
                               path.string(), number, before_family, one_line(line, 60))};
    }
  }
  return std::nullopt;
}

/// One line at the end of the log, with its folder made where it is missing.
std::optional<Error> note(const TestLog& log, const std::string& line) {
  if (auto other = not_a_log(log.path)) {
    return other;
  }
  std::error_code problem;
  if (log.path.has_parent_path()) {
    std::filesystem::create_directories(log.path.parent_path(), problem);
  }
  std::ofstream file(log.path, std::ios::app);
  file << line << '\n';
  file.flush();
  if (!file) {
    return Error{Error::Code::unwritable, log.path.string() + ": cannot be written"};
  }
  return std::nullopt;
}

Suite read_suite(Table table) {
  Suite suite;
  suite.name = table.text("name");
  suite.why = table.text("why");
  for (Table member : table.tables("members")) {
    suite.members.push_back(
        {member.text("family"), member.number("weight", {1e-6, 1e9}), member.text("source")});
    if (suite.members.back().source.empty()) {
      member.reject("source", "want who says so, or \"assumption: ...\", got nothing");
    }
  }
  for (Table cue : table.tables("cues")) {
    const auto kind = scenario::read_word(cue, "kind", world::cue_kind_from, world::cue_kind_words);
    if (std::find(suite.cues.begin(), suite.cues.end(), kind) != suite.cues.end()) {
      cue.reject("kind", "want each kind once, got a second " + std::string(name(kind)));
    }
    suite.cues.push_back(kind);
  }
  if (suite.members.empty()) {
    table.reject("members", "want at least one family, got none");
  }
  return suite;
}

}  // namespace

std::string_view name(Split split) {
  return name_of(split, split_names);
}
std::optional<Split> split_from(std::string_view name) {
  return value_from<Split>(name, split_names);
}

Result<Splits> read_splits(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema("saca.splits/1");
  Splits splits;
  Table seeds = root.table("seeds");
  std::set<std::uint64_t> all;
  for (std::size_t i = 0; i < split_names.size(); ++i) {
    constexpr std::int64_t largest = 1'000'000'000;
    splits.seeds[i] = static_cast<std::uint64_t>(seeds.integer(split_names[i], 1, largest));
    if (!all.insert(splits.seeds[i]).second) {
      seeds.reject(split_names[i], "want a seed that no other split has, got " +
                                       std::to_string(splits.seeds[i]) + " again");
    }
  }
  for (Table family : root.tables("test_only")) {
    splits.test_only.push_back(family.text("family"));
  }
  if (auto error = document.value().error()) {
    return *error;
  }
  return splits;
}

Result<Splits> load_splits(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_splits(text.value(), path.string());
}

Result<std::uint64_t> seed_for(const Splits& splits, Split split, std::string_view family,
                               const std::optional<TestLog>& log) {
  const bool test_only =
      std::find(splits.test_only.begin(), splits.test_only.end(), family) != splits.test_only.end();
  if (test_only && split != Split::test) {
    return Error{Error::Code::out_of_range, "the family " + std::string(family) +
                                                " is kept for the test split, asked for " +
                                                std::string(name(split))};
  }
  if (split == Split::test) {
    if (!log) {
      return Error{Error::Code::out_of_range,
                   "the test split is drawn only when its use is noted: name a log"};
    }
    if (auto problem = note(
            *log, fmt::format("{}{}{}", one_line(log->purpose, 1'000), before_family, family))) {
      return *problem;
    }
  }
  return splits.seeds[static_cast<std::size_t>(split)];
}

Result<std::vector<Suite>> read_suites(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema("saca.suites/1");
  std::vector<Suite> suites;
  for (const Table& table : root.tables("suites")) {
    suites.push_back(read_suite(table));
  }
  std::set<std::string> names;
  for (const Suite& suite : suites) {
    if (!names.insert(suite.name).second) {
      root.reject("suites", "want names that differ, got \"" + suite.name + "\" twice");
    }
  }
  if (suites.empty()) {
    root.reject("suites", "want at least one suite, got none");
  }
  if (auto error = document.value().error()) {
    return *error;
  }
  return suites;
}

Result<std::vector<Suite>> load_suites(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_suites(text.value(), path.string());
}

std::size_t member_of(const Suite& suite, std::uint64_t number) {
  expects(!suite.members.empty(), "a suite has members");
  constexpr double golden = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  double all = 0.0;
  for (const Suite::Member& member : suite.members) {
    all += member.weight;
  }
  const double place = static_cast<double>(number) * golden;
  double left = (place - std::floor(place)) * all;
  for (std::size_t i = 0; i + 1 < suite.members.size(); ++i) {
    left -= suite.members[i].weight;
    if (left < 0.0) {
      return i;
    }
  }
  return suite.members.size() - 1;
}

}  // namespace saca::families
