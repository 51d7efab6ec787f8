#include "saca/lab/cases/example_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/families/splits.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::cases {

namespace {

/// Takes the cases that may be examples, and counts the others.
void take_cases(ExampleSource& all, std::vector<CrashCase> cases,
                const std::vector<std::string>& test_only) {
  for (CrashCase& one : cases) {
    if (!one.kind) {
      ++all.recorded;
    } else if (std::find(test_only.begin(), test_only.end(), *one.kind) != test_only.end()) {
      ++all.test_only;
    } else {
      all.cases.push_back(std::move(one));
    }
  }
}

Result<std::vector<memory::Case>> cases_of_bank(const std::string& bank) {
  auto store = memory::Store::open_existing(bank);
  return store.has_value() ? std::move(store).value().all()
                           : Result<std::vector<memory::Case>>(store.error());
}

}  // namespace

std::string example_text(const ExampleOptions& options) {
  return fmt::format("--car {} --seed {}{}{}", options.car, options.seed,
                     options.memory.empty() ? "" : " --memory " + options.memory,
                     options.cues.empty() ? "" : " --cues " + options.cues);
}

Result<CaseFile> read_cases(const std::string& file) {
  const auto text = formats::read_compressed(file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  auto cases = crash_cases_from_text(text.value(), file);
  if (!cases.has_value()) {
    return cases.error();
  }
  CaseFile read{.cases = std::move(cases).value(), .hash = {}};
  read.hash.add(text.value());
  return read;
}

Result<ExampleSource> open_examples(CaseFile file, const ExampleOptions& options, CaseTools tools,
                                    const std::filesystem::path& scenarios) {
  ExampleSource all;
  all.tools = std::move(tools);
  if (!options.cues.empty()) {
    auto cues = eval::cues_of_suite(scenarios / "families", options.cues);
    if (!cues.has_value()) {
      return Error{cues.error().code, "--cues: " + cues.error().message};
    }
    all.cues = std::move(cues).value();
  }
  const auto splits = families::load_splits(scenarios / "splits.toml");
  if (!splits.has_value()) {
    return splits.error();
  }
  take_cases(all, std::move(file.cases), splits.value().test_only);
  if (all.cases.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases that were drawn from families of the tuning split, "
                             "got {} recorded ones and {} of families for tests",
                             options.file, all.recorded, all.test_only)};
  }
  Fnv hash = file.hash;
  if (!options.memory.empty()) {
    auto stored = cases_of_bank(options.memory);
    if (!stored.has_value()) {
      return stored.error();
    }
    hash.add(memory::cases_text(stored.value()));
    all.told.emplace(std::move(stored).value());
  }
  hash.add(options.cues);
  if (all.cues) {
    hash.add(intent::digest(all.cues->law));
    hash.add(intent::digest(*all.tools.forecast.cues));
  }
  all.digest = hash.value();
  return all;
}

}  // namespace saca::cases
